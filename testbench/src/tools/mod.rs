//! The programs that the test bench calls: where they are, whether they are new enough, and
//! the command that installs them.

mod ask;
mod doctor;
mod headers;
mod known;
mod path;
mod tool;
mod toolchain;

pub use doctor::{Doctor, Examined};
pub use known::*;
pub use path::PYTHON_TOOLS;
pub(crate) use path::{python_cache, search_path};
pub use tool::{Found, Tool, ToolError, Version};
pub use toolchain::Toolchain;
