//! Writing a pack.

use super::beats::pack_all;
use super::text::plain;
use super::*;
use crate::cases::Case;
use std::fs;
use std::path::{Path, PathBuf};
use wheatstone_golden::config::PARAMETERS;
use wheatstone_golden::files::{Scratch, Tidy};
use wheatstone_golden::formats::Eye;
use wheatstone_golden::interface::{Direction, Stream, Table};

/// Name and version of this program.
pub(super) const GENERATOR: &str = concat!("wheatstone ", env!("CARGO_PKG_VERSION"));

/// A pack that was written.
#[derive(Clone, Debug)]
pub struct PackInfo {
    /// Folder of the pack.
    pub folder: PathBuf,
    /// Beats of all streams.
    pub beats: u64,
    /// The manifest.
    pub manifest: Manifest,
}

/// Writes the pack of a case into `out/<target><suffix>`, replacing one that is there. The folder is at all
/// times the old pack or the new one, whole.
pub fn write(
    case: &Case,
    origin: &Origin,
    rtl_blake3: &str,
    out: &Path,
) -> Result<PackInfo, PackError> {
    // Before what is in it: a new folder that stays empty goes last.
    let _tidy = Tidy::new(out);
    fs::create_dir_all(out).map_err(PackError::at(out))?;
    let temporary = Scratch::new(out).map_err(PackError::at(out))?;
    let manifest = fill(case, origin, rtl_blake3, temporary.path())?;
    let folder = out.join(format!("{}{}", case.target.name(), origin.suffix));
    if manifest.is_vain() {
        return Err(PackError::Vain { path: folder });
    }
    publish::publish(temporary, &folder)?;
    Ok(PackInfo { beats: manifest.beats(), folder, manifest })
}

/// Hash of the Verilog that a module can use.
pub fn rtl_hash(rtl: &Path, module: &str) -> Result<String, PackError> {
    let sources = crate::sources::read(rtl, module)
        .map_err(|e| PackError::File { path: e.path, source: e.source })?;
    let mut hasher = blake3::Hasher::new();
    for (name, content) in &sources {
        hasher.update(format!("{name} {}\n", content.len()).as_bytes());
        hasher.update(content);
    }
    Ok(hasher.finalize().to_hex().to_string())
}

fn fill(
    case: &Case,
    origin: &Origin,
    rtl_blake3: &str,
    folder: &Path,
) -> Result<Manifest, PackError> {
    let interface = case.interface();
    let mut inputs = case.inputs.iter();
    let mut outputs = case.outputs.iter();
    let mut ports = Vec::new();
    for stream in &interface.streams {
        let table = match stream.direction {
            Direction::Input => inputs.next(),
            Direction::Output => outputs.next(),
        };
        ports.push(port(stream, table.unwrap_or(&Table::default()), folder)?);
    }
    let values = |names: Vec<&str>, values: &[u64]| {
        let pair = |(name, &value): (&str, &u64)| Value { name: name.into(), value };
        names.into_iter().zip(values).map(pair).collect::<Vec<Value>>()
    };
    let stimulus = match (&origin.scene, origin.seed) {
        (Some(_), _) => "scene",
        (None, Some(_)) => "random",
        (None, None) => "directed",
    };
    let config = if origin.config.is_empty() { "default" } else { &origin.config };
    let mut manifest = Manifest {
        format: FORMAT.into(),
        schema: SCHEMA,
        generator: GENERATOR.into(),
        target: interface.target.into(),
        module: interface.module.into(),
        case: plain(&case.name),
        stimulus: stimulus.into(),
        seed: origin.seed.unwrap_or(0),
        config: config.into(),
        build: PARAMETERS
            .iter()
            .map(|p| Setting { name: p.name.into(), value: case.config.value(p).into() })
            .collect(),
        parameters: interface
            .parameters
            .iter()
            .map(|&(name, value)| Value { name: name.into(), value: value.into() })
            .collect(),
        statics: values(interface.statics.iter().map(|f| f.name).collect(), &case.statics),
        flags: values(interface.flags.iter().map(|f| f.name).collect(), &case.flags),
        frames: frames(case),
        scene: origin.scene.clone(),
        rtl_blake3: rtl_blake3.into(),
        ports,
        bench: Vec::new(),
        hash: String::new(),
    };
    if let Some(scene) = &mut manifest.scene {
        scene.name = plain(&scene.name);
    }
    for (file, text) in bench::files(&manifest, &interface) {
        manifest.bench.push(save(folder, file, text.as_bytes())?);
    }
    manifest.hash = manifest.digest();
    let json = serde_json::to_string_pretty(&manifest).map_err(|error| PackError::Manifest {
        path: folder.join(MANIFEST),
        line: error.line(),
        column: error.column(),
        message: error.to_string(),
    })?;
    save(folder, MANIFEST, format!("{json}\n").as_bytes())?;
    Ok(manifest)
}

/// The frame buffers that a case begins with.
fn frames(case: &Case) -> Option<FrameBuffers> {
    let [before, _] = &**case.memory.as_ref()?;
    let [left, _] = &before.eyes;
    // Every view has a pixel, and nothing is drawn yet.
    let (colour, depth) = (*left.colour.first()?, *left.depth.first()?);
    Some(FrameBuffers {
        width: left.width,
        height: left.height,
        colour,
        depth,
        open: Eye::BOTH.map(|eye| before.open(eye)),
        tested: before.is_tested(),
    })
}

fn port(stream: &Stream, table: &Table, folder: &Path) -> Result<Port, PackError> {
    let fields = packed_fields(&stream.fields);
    let bits = stream.bits();
    let beat_bytes = bits.div_ceil(8) as usize;
    let bytes = pack_all(table, &fields, beat_bytes);
    let text = mem_text(&bytes, beat_bytes, bits);
    Ok(Port {
        name: stream.name.into(),
        direction: direction_name(stream).into(),
        answers: stream.answers.map(Into::into),
        beats: table.len() as u64,
        bits,
        bytes: beat_bytes as u32,
        mem: save(folder, &format!("{}.mem", stream.name), text.as_bytes())?,
        bin: save(folder, &format!("{}.bin", stream.name), &bytes)?,
        crc32: crc32(&bytes),
        fields,
    })
}

fn save(folder: &Path, file: &str, content: &[u8]) -> Result<HashedFile, PackError> {
    let path = folder.join(file);
    let (bytes, limit) = (content.len() as u64, FILE_LIMIT);
    if bytes > limit {
        return Err(PackError::TooLarge { path: file.into(), bytes, limit });
    }
    fs::write(&path, content).map_err(PackError::at(&path))?;
    Ok(HashedFile { file: file.into(), blake3: blake3::hash(content).to_hex().to_string() })
}
