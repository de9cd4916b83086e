//! Vector packs: stimulus and expected beats of one target, for other simulators and for boards.
//!
//! A pack is a folder: `manifest.json` says what is in it; each stream has its beats as a `.mem`
//! file for `$readmemh` (one packed beat a line) and as a `.bin` file (little-endian, each beat
//! padded to whole bytes); `vec.vh` and `replay.v` replay it without this program.
//!
//! A pack may come from anybody. [`check`] reads each file once, and refuses what this version would not
//! have written from the same beats; [`copy`] also puts what it has read into a folder of the caller's own,
//! which alone is replayed.

mod beats;
mod bench;
mod check;
mod consistent;
mod error;
mod folder;
mod manifest;
mod origin;
mod publish;
mod text;
mod write;

pub use check::{check, copy, Checked};
pub use error::PackError;
pub use manifest::*;
pub use origin::{Drawn, Origin};
pub use publish::replaceable;
pub use write::{rtl_hash, write, PackInfo};

use beats::{crc32, direction_name, mem_text, packed_fields, padded_with_ones};
use std::path::Path;
use wheatstone_golden::files;

/// True if a folder is that of a pack, sound or not.
pub fn is_pack(folder: &Path) -> bool {
    let manifest = files::read(&folder.join(MANIFEST), MANIFEST_LIMIT);
    manifest.is_ok_and(|bytes| String::from_utf8_lossy(&bytes).contains(FORMAT))
}

/// Format that every manifest names.
const FORMAT: &str = "wheatstone-vectors";
/// Most bytes of a manifest.
const MANIFEST_LIMIT: u64 = 1 << 20;
/// Most bytes of any other file.
const FILE_LIMIT: u64 = 512 << 20;
/// Most random beats, or beats of a scene, that a pack is asked for.
pub const BEATS_LIMIT: u64 = 1_000_000;
