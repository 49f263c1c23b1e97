//! Rules for the islands of a mesh, face by face.
//!
//! A rule selects faces. Where islands are given, one selected face selects its whole island; new charts
//! are cut along the borders of selections. So all faces of a chart have the same rules ([`FaceRules`]).

use std::collections::hash_map::Entry;
use std::collections::{BTreeMap, HashMap};

use crate::PipelineError;
use crate::island_error::IslandError;
use crate::options::{Action, IslandRule};
use unwrapd_layout::atlas::Region;

/// Rules for the faces of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct FaceControl {
    /// For each face its rules, as an index of `rules`.
    pub of_face: Vec<u32>,
    /// Rules of faces that have the same ones. The first are those of faces without any.
    pub rules: Vec<FaceRules>,
    /// For each rule its text, and the faces that it selects, in ascending order.
    pub selected: Vec<(String, Vec<u32>)>,
}

/// Rules for the faces of an island.
#[derive(Clone, Debug, PartialEq)]
pub struct FaceRules {
    /// Number of the rule that makes them stay where they are.
    pub lock: Option<u32>,
    /// Number of the rule that makes them keep their relative positions.
    pub group: Option<u32>,
    /// Rectangle in which they stay, by its name.
    pub region: Option<(String, Region)>,
    /// Their texel density; `None` if it follows from the others.
    pub density: Option<DensityRule>,
    /// Factor of their size beside the others.
    pub scale: f64,
    /// `true` if their nearly straight borders become straight.
    pub straightens: bool,
}

/// Texel density of islands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DensityRule {
    /// Texels per unit of length of the mesh.
    Texels(f64),
    /// That of the given UVs.
    Kept,
    /// The mean of all islands with this rule, by its number.
    Equal(u32),
}

impl Default for FaceRules {
    fn default() -> Self {
        Self {
            lock: None,
            group: None,
            region: None,
            density: None,
            scale: 1.0,
            straightens: false,
        }
    }
}

impl FaceRules {
    /// Returns whether the size does not depend on the other islands.
    pub fn is_sized(&self) -> bool {
        matches!(
            self.density,
            Some(DensityRule::Texels(_) | DensityRule::Kept)
        )
    }

    /// Returns whether each island keeps something of its own, so that it cannot get the UVs of another one.
    pub fn is_by_itself(&self) -> bool {
        self.lock.is_some()
            || self.group.is_some()
            || matches!(self.density, Some(DensityRule::Kept))
    }

    /// Returns the number of the rule that an action contradicts, if there is one.
    fn contradicted(&self, action: &Action) -> Option<u32> {
        match action {
            Action::Lock => self.group,
            Action::Group => self.group.or(self.lock),
            _ => None,
        }
    }

    /// Adds the action of a rule.
    fn add(
        &mut self,
        number: u32,
        action: &Action,
        region: &impl Fn(&str) -> Result<Region, String>,
    ) -> Result<(), PipelineError> {
        match action {
            Action::Lock => self.lock = Some(number),
            Action::Group => self.group = Some(number),
            Action::In(name) => {
                let found = region(name).map_err(PipelineError::InvalidOptions)?;
                self.region = Some((name.clone(), found));
            }
            Action::Density(texels) => self.density = Some(DensityRule::Texels(*texels)),
            Action::KeepDensity => self.density = Some(DensityRule::Kept),
            Action::EqualizeDensity => self.density = Some(DensityRule::Equal(number)),
            Action::Scale(scale) => self.scale = *scale,
            Action::Straighten => self.straightens = true,
        }
        Ok(())
    }
}

impl FaceControl {
    /// Combines rules for `n_faces` faces. `selected` are the faces of each rule, and `region` returns the region that a
    /// rule names.
    pub fn new(
        n_faces: usize,
        rules: &[IslandRule],
        selected: Vec<Vec<u32>>,
        region: impl Fn(&str) -> Result<Region, String>,
    ) -> Result<Self, PipelineError> {
        let mut control = Self {
            of_face: vec![0; n_faces],
            rules: vec![FaceRules::default()],
            selected: Vec::new(),
        };
        for ((number, rule), faces) in (0..).zip(rules).zip(selected) {
            // The rules that faces have once this one is added to those before.
            let mut with_rule: HashMap<u32, u32> = HashMap::new();
            for &face in &faces {
                let before = control.of_face[face as usize];
                let Entry::Vacant(new) = with_rule.entry(before) else {
                    control.of_face[face as usize] = with_rule[&before];
                    continue;
                };
                let mut now = control.rules[before as usize].clone();
                if let Some(other) = now.contradicted(&rule.action) {
                    let rules = [&rules[other as usize], rule].map(ToString::to_string);
                    return Err(IslandError::Conflict { face, rules }.into());
                }
                now.add(number, &rule.action, &region)?;
                control.of_face[face as usize] = *new.insert(control.rules.len() as u32);
                control.rules.push(now);
            }
            control.selected.push((rule.to_string(), faces));
        }
        control.check_groups(rules)?;
        Ok(control)
    }

    /// Rejects groups whose islands are to lie or to grow differently.
    fn check_groups(&self, rules: &[IslandRule]) -> Result<(), IslandError> {
        let mut of_group: BTreeMap<u32, &FaceRules> = BTreeMap::new();
        for (face, own) in (0..).zip(&self.of_face) {
            let own = &self.rules[*own as usize];
            let Some(group) = own.group else {
                continue;
            };
            if **of_group.entry(group).or_insert(own) != *own {
                return Err(IslandError::DividedGroup {
                    face,
                    rule: rules[group as usize].to_string(),
                });
            }
        }
        Ok(())
    }

    /// Returns the rules of a face.
    pub fn of(&self, face: u32) -> &FaceRules {
        &self.rules[self.of_face[face as usize] as usize]
    }

    /// Returns the factor of the size of each face; `None` if all are 1.
    pub fn scales(&self) -> Option<Vec<f64>> {
        let is_scaled = self.rules.iter().any(|rules| rules.scale != 1.0);
        let scale = |&own: &u32| self.rules[own as usize].scale;
        is_scaled.then(|| self.of_face.iter().map(scale).collect())
    }

    /// Restricts the rules to some faces.
    #[must_use]
    pub fn restricted(&self, faces: &[u32]) -> Self {
        Self {
            of_face: faces.iter().map(|&f| self.of_face[f as usize]).collect(),
            rules: self.rules.clone(),
            selected: Vec::new(),
        }
    }
}
