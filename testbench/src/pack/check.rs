//! Verifying a pack.

use super::*;
use std::fs;
use std::path::{Path, PathBuf};
use wheatstone_golden::config::Config;
use wheatstone_golden::interface::{Direction, Stream};
use wheatstone_golden::targets::Target;

/// A pack that was found sound.
#[derive(Clone, Debug)]
pub struct Checked {
    /// Its folder.
    pub folder: PathBuf,
    /// What it says of itself.
    pub manifest: Manifest,
}

/// Verifies the pack in a folder, or all packs in the folders of a folder.
pub fn check(folder: &Path) -> Result<Vec<Checked>, PackError> {
    if folder.join(MANIFEST).exists() {
        return Ok(vec![check_one(folder)?]);
    }
    let entries = fs::read_dir(folder).map_err(PackError::at(folder))?;
    let mut folders: Vec<PathBuf> = entries
        .filter_map(|entry| entry.ok())
        .map(|entry| entry.path())
        .filter(|path| path.join(MANIFEST).exists())
        .collect();
    folders.sort();
    if folders.is_empty() {
        return Err(PackError::Missing { path: folder.into() });
    }
    folders.iter().map(|folder| check_one(folder)).collect()
}

fn list<'a>(names: impl Iterator<Item = &'a str>) -> String {
    names.collect::<Vec<_>>().join(", ")
}

/// Compares what a manifest says with what is so.
struct Checker<'a> {
    folder: &'a Path,
    path: PathBuf,
}

impl Checker<'_> {
    fn same<T: PartialEq + ToString>(
        &self,
        field: &str,
        found: T,
        expected: T,
    ) -> Result<(), PackError> {
        if found == expected {
            return Ok(());
        }
        let (path, field) = (self.path.clone(), field.to_owned());
        Err(PackError::Field {
            path,
            field,
            found: found.to_string(),
            expected: expected.to_string(),
        })
    }

    /// The content of a file that has the hash it should have.
    fn content(&self, field: &str, file: &HashedFile) -> Result<Vec<u8>, PackError> {
        let path = self.folder.join(&file.file);
        let is_name = Path::new(&file.file).file_name().is_some_and(|name| *name == *file.file);
        if !is_name || file.file.contains('\\') {
            return self
                .same(field, file.file.as_str(), "a name without a folder")
                .map(|()| Vec::new());
        }
        let content = fs::read(&path).map_err(PackError::at(&path))?;
        let hash = blake3::hash(&content).to_hex().to_string();
        if hash != file.blake3 {
            return Err(PackError::Field {
                path,
                field: format!("{field}.blake3"),
                found: format!("the file has {hash} ({} bytes)", content.len()),
                expected: file.blake3.clone(),
            });
        }
        Ok(content)
    }

    fn port(&self, port: &Port, stream: &Stream) -> Result<(), PackError> {
        let field = |name: &str| format!("ports.{}.{name}", port.name);
        let direction = match stream.direction {
            Direction::Input => "input",
            Direction::Output => "output",
        };
        self.same(&field("direction"), port.direction.as_str(), direction)?;
        self.same(
            &field("answers"),
            port.answers.as_deref().unwrap_or("nothing"),
            stream.answers.unwrap_or("nothing"),
        )?;
        let found = list(port.fields.iter().map(|f| f.name.as_str()));
        self.same(&field("fields"), found, list(stream.fields.iter().map(|f| f.name)))?;
        let mut lsb = 0;
        for packed in &port.fields {
            self.same(&field(&format!("fields.{}.lsb", packed.name)), packed.lsb, lsb)?;
            if !(1..=64).contains(&packed.bits) {
                let name = field(&format!("fields.{}.bits", packed.name));
                return self.same(&name, packed.bits.to_string(), "1 to 64".into());
            }
            lsb = lsb.saturating_add(packed.bits);
        }
        self.same(&field("bits"), port.bits, lsb)?;
        self.same(&field("bytes"), port.bytes, port.bits.div_ceil(8))?;
        let bin = self.content(&field("bin"), &port.bin)?;
        self.same(&field("beats"), port.beats.saturating_mul(port.bytes.into()), bin.len() as u64)?;
        self.same(&field("crc32"), port.crc32.clone(), crc32(&bin))?;
        let mem = self.content(&field("mem"), &port.mem)?;
        let expected = mem_text(&bin, port.bytes as usize, port.bits);
        if mem != expected.as_bytes() {
            let line = mem.split(|&b| b == b'\n').zip(expected.lines());
            let line = line.take_while(|(a, b)| *a == b.as_bytes()).count() + 1;
            let found = format!("{} differs from {} at line {line}", port.mem.file, port.bin.file);
            return self.same(&field("mem"), found, "the same beats in both files".into());
        }
        Ok(())
    }
}

fn check_one(folder: &Path) -> Result<Checked, PackError> {
    let path = folder.join(MANIFEST);
    let text = fs::read_to_string(&path).map_err(PackError::at(&path))?;
    let fault = |error: serde_json::Error| PackError::Manifest {
        path: path.clone(),
        line: error.line(),
        column: error.column(),
        message: error.to_string(),
    };
    let checker = Checker { folder, path: path.clone() };
    // The version first: a newer layout may have fields that this one does not know.
    let value: serde_json::Value = serde_json::from_str(&text).map_err(fault)?;
    let format = value.get("format").and_then(|f| f.as_str()).unwrap_or("nothing");
    checker.same("format", format, "wheatstone-vectors")?;
    let schema = value.get("schema").and_then(|s| s.as_u64());
    if schema != Some(SCHEMA.into()) {
        let found = value.get("schema").map_or("nothing".into(), |s| s.to_string());
        return checker
            .same("schema", found, format!("{SCHEMA}; a newer pack needs a newer wheatstone"))
            .map(|()| unreachable!("the two texts differ"));
    }
    let manifest: Manifest = serde_json::from_str(&text).map_err(fault)?;
    let Some(target) = Target::named(&manifest.target) else {
        let (found, expected) = (manifest.target.as_str(), "a target that `wheatstone list` names");
        return checker.same("target", found, expected).map(|()| unreachable!("no target has it"));
    };
    checker.same("module", manifest.module.as_str(), target.module())?;
    // Widths depend on the parameters; names do not.
    let streams = target.interface(&Config::DEFAULT).streams;
    let found = list(manifest.ports.iter().map(|p| p.name.as_str()));
    checker.same("ports", found, list(streams.iter().map(|s| s.name)))?;
    for (port, stream) in manifest.ports.iter().zip(&streams) {
        checker.port(port, stream)?;
    }
    for file in &manifest.bench {
        checker.content(&format!("bench.{}", file.file), file)?;
    }
    Ok(Checked { folder: folder.into(), manifest })
}
