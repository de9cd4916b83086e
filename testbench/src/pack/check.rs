//! Verifying a pack.

use super::*;
use std::fmt::Display;
use std::fs;
use std::path::{Path, PathBuf};
use wheatstone_golden::config::{Config, PARAMETERS};
use wheatstone_golden::interface::Interface;
use wheatstone_golden::targets::Target;

/// A pack that was found sound.
#[derive(Clone, Debug)]
pub struct Checked {
    /// Its folder.
    pub folder: PathBuf,
    /// What it says of itself.
    pub manifest: Manifest,
    /// The interface of its target.
    pub interface: Interface,
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

fn list<S: Into<String>>(names: impl Iterator<Item = S>) -> String {
    names.map(Into::into).collect::<Vec<_>>().join(", ")
}

/// Parameters, or what else has a name and a number.
fn told<'a, N: Display>(values: impl Iterator<Item = (&'a str, N)>) -> String {
    list(values.map(|(name, value)| format!("{name}={value}")))
}

/// Compares what a manifest says with what is so.
struct Checker<'a> {
    folder: &'a Path,
    path: PathBuf,
}

impl Checker<'_> {
    /// A field of the manifest that does not fit the rest.
    fn fault(&self, field: &str, found: impl ToString, expected: impl ToString) -> PackError {
        let (path, field) = (self.path.clone(), field.to_owned());
        PackError::Field { path, field, found: found.to_string(), expected: expected.to_string() }
    }

    fn same<T: PartialEq + ToString>(
        &self,
        field: &str,
        found: T,
        expected: T,
    ) -> Result<(), PackError> {
        match found == expected {
            true => Ok(()),
            false => Err(self.fault(field, found, expected)),
        }
    }

    /// The content of a file that has the hash it should have.
    fn content(&self, field: &str, file: &HashedFile) -> Result<Vec<u8>, PackError> {
        let path = self.folder.join(&file.file);
        let is_name = Path::new(&file.file).file_name().is_some_and(|name| *name == *file.file);
        if !is_name || file.file.contains('\\') {
            return Err(self.fault(field, &file.file, "a name without a folder"));
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

    /// Names and values of static inputs or of flags.
    fn values(&self, field: &str, found: &[Value], fields: &[Field]) -> Result<(), PackError> {
        let names = list(found.iter().map(|value| value.name.as_str()));
        self.same(field, names, list(fields.iter().map(|f| f.name)))?;
        match found.iter().zip(fields).find(|(value, field)| value.value > field.mask()) {
            Some((Value { name, value }, Field { bits, .. })) => {
                Err(self.fault(&format!("{field}.{name}"), value, format!("{bits} bits at most")))
            }
            None => Ok(()),
        }
    }

    fn port(&self, port: &Port, stream: &Stream) -> Result<(), PackError> {
        let field = |name: &str| format!("ports.{}.{name}", port.name);
        self.same(&field("direction"), port.direction.as_str(), direction_name(stream))?;
        self.same(
            &field("answers"),
            port.answers.as_deref().unwrap_or("nothing"),
            stream.answers.unwrap_or("nothing"),
        )?;
        let found = list(port.fields.iter().map(|f| f.name.as_str()));
        self.same(&field("fields"), found, list(stream.fields.iter().map(|f| f.name)))?;
        for (found, expected) in port.fields.iter().zip(packed_fields(&stream.fields)) {
            let field = |name: &str| field(&format!("fields.{}.{name}", found.name));
            self.same(&field("lsb"), found.lsb, expected.lsb)?;
            self.same(&field("bits"), found.bits, expected.bits)?;
            self.same(&field("signed"), found.signed, expected.signed)?;
            self.same(&field("fraction"), found.fraction, expected.fraction)?;
            self.same(&field("doc"), &found.doc, &expected.doc)?;
        }
        self.same(&field("bits"), port.bits, stream.bits())?;
        self.same(&field("bytes"), port.bytes, port.bits.div_ceil(8))?;
        let bin = self.content(&field("bin"), &port.bin)?;
        self.same(&field("beats"), port.beats.saturating_mul(port.bytes.into()), bin.len() as u64)?;
        self.same(&field("crc32"), port.crc32.clone(), crc32(&bin))?;
        let mem = self.content(&field("mem"), &port.mem)?;
        self.text(
            &field("mem"),
            &port.mem.file,
            &mem,
            &mem_text(&bin, port.bytes as usize, port.bits),
        )
    }

    /// Compares a file with what the rest of the pack says it has.
    fn text(&self, field: &str, file: &str, found: &[u8], expected: &str) -> Result<(), PackError> {
        if found == expected.as_bytes() {
            return Ok(());
        }
        let lines = found.split(|&b| b == b'\n').zip(expected.split('\n'));
        let line = 1 + lines.take_while(|(found, line)| *found == line.as_bytes()).count();
        let found = format!("{file} differs at line {line}");
        Err(self.fault(field, found, "what the rest of the pack says"))
    }

    /// The files that replay the pack.
    fn bench(&self, manifest: &Manifest, interface: &Interface) -> Result<(), PackError> {
        let content = |file: &HashedFile| self.content(&format!("bench.{}", file.file), file);
        let contents = manifest.bench.iter().map(content).collect::<Result<Vec<_>, _>>()?;
        self.same("hash", manifest.hash.clone(), manifest.digest())?;
        let files = replay::files(manifest, interface);
        let found = list(manifest.bench.iter().map(|file| file.file.as_str()));
        self.same("bench", found, list(files.iter().map(|(file, _)| *file)))?;
        for (content, (file, text)) in contents.iter().zip(&files) {
            self.text(&format!("bench.{file}"), file, content, text)?;
        }
        Ok(())
    }
}

/// The interface of a target with these parameters: it is the same in all configurations that have them.
fn interface(target: Target, parameters: &[Value]) -> Option<Interface> {
    let same = |(a, b): (&(&str, u32), &Value)| a.0 == b.name && u64::from(a.1) == b.value;
    let mut all = configurations().into_iter().map(|config| target.interface(&config));
    all.find(|i| {
        i.parameters.len() == parameters.len() && i.parameters.iter().zip(parameters).all(same)
    })
}

/// Every configuration that can be built.
fn configurations() -> Vec<Config> {
    PARAMETERS.iter().fold(vec![Config::DEFAULT], |configs, parameter| {
        let with = |&config: &Config| {
            parameter.values.iter().filter_map(move |value| {
                let mut config = config;
                config.set(parameter.name, value).ok().map(|()| config)
            })
        };
        configs.iter().flat_map(with).collect()
    })
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
        let expected = format!("{SCHEMA}; a newer pack needs a newer wheatstone");
        return Err(checker.fault("schema", found, expected));
    }
    let manifest: Manifest = serde_json::from_str(&text).map_err(fault)?;
    let target = Target::named(&manifest.target).ok_or_else(|| {
        checker.fault("target", &manifest.target, "a target that `wheatstone list` names")
    })?;
    checker.same("module", manifest.module.as_str(), target.module())?;
    let interface = interface(target, &manifest.parameters).ok_or_else(|| {
        let found = told(manifest.parameters.iter().map(|p| (p.name.as_str(), p.value)));
        let usual = told(target.interface(&Config::DEFAULT).parameters.into_iter());
        checker.fault("parameters", found, format!("those of a configuration, as {usual}"))
    })?;
    checker.values("statics", &manifest.statics, &interface.statics)?;
    checker.values("flags", &manifest.flags, &interface.flags)?;
    let found = list(manifest.ports.iter().map(|p| p.name.as_str()));
    checker.same("ports", found, list(interface.streams.iter().map(|s| s.name)))?;
    for (port, stream) in manifest.ports.iter().zip(&interface.streams) {
        checker.port(port, stream)?;
    }
    checker.bench(&manifest, &interface)?;
    Ok(Checked { folder: folder.into(), manifest, interface })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    #[test]
    fn parameters_decide_an_interface() {
        let count: usize = PARAMETERS.iter().map(|p| p.values.len()).product();
        assert_eq!(configurations().len(), count);
        for target in Target::ALL {
            let mut all: BTreeMap<Vec<(&str, u32)>, Interface> = BTreeMap::new();
            for interface in configurations().iter().map(|config| target.interface(config)) {
                let first = all.entry(interface.parameters.clone()).or_insert(interface.clone());
                assert_eq!(*first, interface, "{}", target.name());
            }
        }
    }
}
