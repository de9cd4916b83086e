//! A bug that a property catches.

use crate::flow::FlowError;
use crate::sources::{Sources, FORMAL};

/// A text of a module's Verilog that another one takes the place of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bug {
    /// The module whose property catches it, without `sam_`.
    pub module: &'static str,
    /// The label of that property.
    pub property: &'static str,
    /// A label of the build in which it shows.
    pub build: &'static str,
    /// The text; it occurs once in the module.
    pub find: &'static str,
    /// The text that takes its place.
    pub replace: &'static str,
}

impl Bug {
    /// Plants it.
    pub(in crate::prove) fn plant(&self, sources: &mut Sources) -> Result<(), FlowError> {
        let file = sources.get_mut(&format!("sam_{}.v", self.module));
        let file = file.ok_or_else(|| self.fault("there is no such module"))?;
        let text = String::from_utf8_lossy(file).into_owned();
        let hardware = text.split(FORMAL).next().unwrap_or_default();
        match hardware.matches(self.find).count() {
            1 => *file = text.replacen(self.find, self.replace, 1).into_bytes(),
            times => return Err(self.fault(&format!("the text occurs {times} times, not once"))),
        }
        Ok(())
    }

    /// The fault of this entry of the list.
    pub(in crate::prove) fn fault(&self, why: &str) -> FlowError {
        let Bug { module, property, find, .. } = self;
        FlowError::Bug { what: format!("{module}, {property}, “{find}”"), why: why.to_owned() }
    }
}

/// A bug of the build `default`.
pub(super) const fn bug(
    module: &'static str,
    property: &'static str,
    find: &'static str,
    replace: &'static str,
) -> Bug {
    bug_in("default", module, property, find, replace)
}

/// A bug of another build.
pub(super) const fn bug_in(
    build: &'static str,
    module: &'static str,
    property: &'static str,
    find: &'static str,
    replace: &'static str,
) -> Bug {
    Bug { module, property, build, find, replace }
}
