//! Writing a pack.

use super::*;
use crate::cases::Case;
use std::fs;
use std::path::{Path, PathBuf};
use wheatstone_golden::files::{publish, Scratch};
use wheatstone_golden::interface::Table;

/// What was written.
#[derive(Clone, Debug)]
pub struct PackInfo {
    /// Folder of the pack.
    pub folder: PathBuf,
    /// Beats of all streams.
    pub beats: u64,
    /// The manifest.
    pub manifest: Manifest,
}

/// Writes the pack of a case into `out/<target>`, replacing one that is there. The folder appears
/// complete or not at all.
pub fn write(case: &Case, seed: u64, rtl_blake3: &str, out: &Path) -> Result<PackInfo, PackError> {
    fs::create_dir_all(out).map_err(PackError::at(out))?;
    let temporary = Scratch::new(out).map_err(PackError::at(out))?;
    let manifest = fill(case, seed, rtl_blake3, temporary.path())?;
    let folder = out.join(case.target.name());
    replace(temporary, &folder)?;
    Ok(PackInfo { beats: manifest.ports.iter().map(|p| p.beats).sum(), folder, manifest })
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

/// Puts a finished folder in the place of an older one.
fn replace(finished: Scratch, folder: &Path) -> Result<(), PackError> {
    if folder.exists() && !folder.join(MANIFEST).exists() {
        let source = std::io::Error::other("exists and is no vector pack; it is left alone");
        return Err(PackError::File { path: folder.into(), source });
    }
    publish(finished, folder).map_err(|e| PackError::File { path: e.file, source: e.source })
}

fn fill(case: &Case, seed: u64, rtl_blake3: &str, folder: &Path) -> Result<Manifest, PackError> {
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
    let mut manifest = Manifest {
        format: "wheatstone-vectors".into(),
        schema: SCHEMA,
        generator: concat!("wheatstone ", env!("CARGO_PKG_VERSION")).into(),
        target: interface.target.into(),
        module: interface.module.into(),
        case: case.name.clone(),
        seed,
        parameters: interface
            .parameters
            .iter()
            .map(|&(name, value)| Value { name: name.into(), value: value.into() })
            .collect(),
        statics: values(interface.statics.iter().map(|f| f.name).collect(), &case.statics),
        flags: values(interface.flags.iter().map(|f| f.name).collect(), &case.flags),
        rtl_blake3: rtl_blake3.into(),
        ports,
        bench: Vec::new(),
        hash: String::new(),
    };
    for (file, text) in replay::files(&manifest, &interface) {
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

fn port(stream: &Stream, table: &Table, folder: &Path) -> Result<Port, PackError> {
    let fields = packed_fields(&stream.fields);
    let bits = stream.bits();
    let beat_bytes = bits.div_ceil(8) as usize;
    let mut bytes = Vec::with_capacity(table.len() * beat_bytes);
    for index in 0..table.len() {
        pack(table.row(index), &fields, &mut bytes);
    }
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
    fs::write(&path, content).map_err(PackError::at(&path))?;
    Ok(HashedFile { file: file.into(), blake3: blake3::hash(content).to_hex().to_string() })
}
