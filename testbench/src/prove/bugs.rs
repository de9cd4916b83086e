//! The bugs that the properties catch: at least one of each property.

use crate::flow::FlowError;
use crate::sources::Sources;

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
    /// What takes its place.
    pub replace: &'static str,
}

impl Bug {
    /// Plants it.
    pub(super) fn plant(&self, sources: &mut Sources) -> Result<(), FlowError> {
        let file = sources.get_mut(&format!("sam_{}.v", self.module));
        let file = file.ok_or_else(|| self.fault("there is no such module"))?;
        let text = String::from_utf8_lossy(file).into_owned();
        match text.matches(self.find).count() {
            1 => *file = text.replace(self.find, self.replace).into_bytes(),
            times => return Err(self.fault(&format!("the text occurs {times} times, not once"))),
        }
        Ok(())
    }

    /// What is wrong with this entry of the list.
    pub(super) fn fault(&self, why: &str) -> FlowError {
        let Bug { module, property, find, .. } = self;
        FlowError::Bug { what: format!("{module}, {property}, “{find}”"), why: why.to_owned() }
    }
}

/// A bug of the build `default`.
const fn bug(
    module: &'static str,
    property: &'static str,
    find: &'static str,
    replace: &'static str,
) -> Bug {
    bug_in("default", module, property, find, replace)
}

/// A bug of another build.
const fn bug_in(
    build: &'static str,
    module: &'static str,
    property: &'static str,
    find: &'static str,
    replace: &'static str,
) -> Bug {
    Bug { module, property, build, find, replace }
}

/// All of them.
pub const BUGS: &[Bug] = &[
    // BUGS
];
