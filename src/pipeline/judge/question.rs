//! What is asked of a document's UVs, by its caller and by its own mark.

use crate::certificate::Overlap;
use crate::document::{Document, Mark, Marked, Warning};
use crate::pipeline::PipelineError;
use crate::pipeline::options::{CommandOptions, MeasureOptions};

/// What is asked of a document's UVs.
pub struct Question {
    /// The options, and where these say nothing what the mark says.
    pub options: MeasureOptions,
    /// The mark of the document, where that is asked for.
    pub mark: Option<Mark>,
    /// What is to be said of the mark.
    pub warning: Option<Warning>,
}

impl Question {
    /// The question that `options` are, of a document that may say itself what it is to be asked.
    pub fn new(options: &MeasureOptions, document: &Document) -> Result<Self, PipelineError> {
        let marked = match options.texcoord {
            Some(_) => Marked::Not,
            None => document.marked()?,
        };
        let mut question = Self {
            options: options.clone(),
            mark: None,
            warning: None,
        };
        match marked {
            Marked::Not => {}
            Marked::Stale => question.warning = Some(stale()),
            Marked::Fits(mark) => {
                let with_terms = options.with_terms(&mark.terms);
                // Not every number that a file has can be asked for.
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

    /// The UV set of a primitive that takes part.
    pub fn set_of(&self, primitive: usize) -> Option<u32> {
        match &self.mark {
            Some(mark) => mark.sets.of(primitive),
            None => Some(self.options.texcoord.unwrap_or(0)),
        }
    }

    /// The charts that alone are asked for, each by itself.
    pub fn charts(&self) -> Option<&[u32]> {
        self.mark.as_ref()?.terms.charts.as_deref()
    }

    /// Whether pairs of faces have to be tested, where `asked` says whether they are asked for.
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

    /// Whether faces may overlap: not if the document says so itself, whatever is `asked`.
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
