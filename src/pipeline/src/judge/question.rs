//! Selection of the UVs to judge, and the properties to judge.
//!
//! A record in the file may name the UV set and add requirements. The judged faces, and the grouping into UV spaces,
//! follow only from the file's meshes and materials and from the caller: a file cannot exempt itself from a test.

use crate::PipelineError;
use crate::options::{CommandOptions, MeasureOptions};
use unwrapd_files::document::{Document, DocumentError, Mark, Marked, Sets, Warning};
use unwrapd_maps::certificate::Overlap;

/// UVs of a document to judge, and the properties to judge.
pub struct Question {
    /// Options, with the requirements that the record adds.
    pub options: MeasureOptions,
    /// Record of the document, if it matches the UVs and the caller named no set.
    pub mark: Option<Mark>,
    /// Warning about the record.
    pub warning: Option<Warning>,
}

impl Question {
    /// Creates the question that `options` ask of a document, with the requirements that its record adds.
    pub fn new(options: &MeasureOptions, document: &Document) -> Result<Self, PipelineError> {
        let marked = match options.texcoord {
            Some(_) => Marked::Not,
            None => document.marked()?,
        };
        let mut question = Self::of_options(options);
        match marked {
            Marked::Not => {}
            Marked::Stale => question.warning = Some(stale()),
            Marked::Fits(mark) => {
                let with_terms = options.with_terms(&mark.terms);
                // A record may hold numbers that options do not allow.
                if with_terms.check().is_ok() {
                    question.options = with_terms;
                    question.mark = Some(*mark);
                } else {
                    question.warning = Some(stale());
                }
            }
        }
        Ok(question)
    }

    /// Creates the question that `options` ask of UVs without a record.
    pub fn of_options(options: &MeasureOptions) -> Self {
        Self {
            options: options.clone(),
            mark: None,
            warning: None,
        }
    }

    /// Returns the UV sets to judge, by primitive.
    pub fn sets(&self) -> Sets {
        match &self.mark {
            Some(mark) => mark.sets.clone(),
            None => Sets::One(self.options.texcoord.unwrap_or(0)),
        }
    }

    /// Returns the UV set of every primitive; `None` for one that lacks the set and is left out at the caller's
    /// request.
    ///
    /// A primitive for which the record names no set is judged, too: in the lowest set that the record names.
    pub fn set_of_each(&self, document: &Document) -> Result<Vec<Option<u32>>, DocumentError> {
        let sets = self.sets();
        let lowest = sets.lowest().unwrap_or(0);
        let set = |primitive: usize| {
            let set = sets.of(primitive).unwrap_or(lowest);
            let is_left_out =
                self.options.skip_missing && document.corner_uvs(primitive, set)?.is_none();
            Ok((!is_left_out).then_some(set))
        };
        (0..document.primitives().len()).map(set).collect()
    }

    /// Returns whether pairs of faces have to be tested, if `asked` is what the caller requests.
    pub fn overlap(&self, asked: Overlap) -> Overlap {
        let options = &self.options;
        let needs_pairs = options.padding.is_some()
            || options.bits.is_some()
            || options.pages.is_some()
            || options.aligned;
        if needs_pairs {
            Overlap::Test
        } else {
            self.promised(asked)
        }
    }

    /// Returns whether faces may overlap: not if the record promises that they do not, whatever is `asked`.
    pub fn promised(&self, asked: Overlap) -> Overlap {
        match &self.mark {
            Some(mark) if !mark.terms.overlaps => Overlap::Test,
            _ => asked,
        }
    }
}

fn stale() -> Warning {
    Warning::new(
        "mark_stale",
        "the UVs changed since unwrapd recorded its options, so the record is ignored",
    )
}
