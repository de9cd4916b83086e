//! A target as the tools read it.

use crate::flow::{self, FlowError, Folder};
use crate::sources::Sources;
use serde::de::DeserializeOwned;
use serde::Serialize;
use std::path::Path;
use wheatstone_golden::interface::Interface;

/// A target with its parameters and all its Verilog.
pub(crate) struct Design<'a> {
    /// Module and parameters.
    pub interface: &'a Interface,
    /// All files that the module can use.
    pub sources: &'a Sources,
    /// Folder in which working folders are made.
    pub cache: &'a Path,
}

impl Design<'_> {
    /// Name of the module.
    pub fn module(&self) -> &'static str {
        self.interface.module
    }

    /// Yosys commands that read the Verilog and set the parameters.
    pub fn read_commands(&self) -> String {
        flow::read_commands(self.sources, self.module(), &self.interface.parameters)
    }

    /// The result of `measure`, kept under a hash of the sources and of `inputs`: everything else that
    /// the result depends on.
    pub(super) fn cached<T: Serialize + DeserializeOwned>(
        &self,
        inputs: &[&[u8]],
        measure: impl FnOnce(&Folder) -> Result<T, FlowError>,
    ) -> Result<T, FlowError> {
        flow::cached(self.cache, self.module(), self.sources, inputs, |_| true, measure)
    }
}
