//! Verifying a pack.

use super::bench::BENCH;
use super::folder::Folder;
use super::text::{fault, is_hash};
use super::*;
use crate::settings::RUN_PARAMETERS;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use wheatstone_golden::config::{Config, PARAMETERS};
use wheatstone_golden::files::{self, Scratch, Tidy};
use wheatstone_golden::formats::{Formats, DEPTH_MAX};
use wheatstone_golden::interface::{Field, Interface, Stream};
use wheatstone_golden::projection::{Kind, PARTITIONS_LIMIT};
use wheatstone_golden::targets::Target;
use wheatstone_golden::text::decode;

/// A pack that was found sound.
#[derive(Clone, Debug)]
pub struct Checked {
    /// Its folder.
    pub folder: PathBuf,
    /// Its manifest.
    pub manifest: Manifest,
    /// The interface of its target.
    pub interface: Interface,
}

/// Verifies the pack in a folder, or all packs in the folders of a folder. Hidden folders, among which those
/// of packs that are being written are, and links are none of them.
pub fn check(folder: &Path) -> Result<Vec<Checked>, PackError> {
    is_folder(folder)?;
    if fs::symlink_metadata(folder.join(MANIFEST)).is_ok() {
        return Ok(vec![check_one(folder, None)?]);
    }
    let mut folders = Vec::new();
    for entry in fs::read_dir(folder).map_err(PackError::at(folder))? {
        let entry = entry.map_err(PackError::at(folder))?;
        let hidden = entry.file_name().to_string_lossy().starts_with('.');
        let is_folder = entry.file_type().map_err(PackError::at(entry.path()))?.is_dir();
        // A pack that has lost its manifest is none that can be passed over.
        let is_there = |name| fs::symlink_metadata(entry.path().join(name)).is_ok();
        if !hidden && is_folder && [MANIFEST, BENCH].into_iter().any(is_there) {
            folders.push(entry.path());
        }
    }
    folders.sort();
    if folders.is_empty() {
        return Err(PackError::Missing { path: folder.into() });
    }
    folders.iter().map(|folder| check_one(folder, None)).collect()
}

/// Verifies the pack in a folder and puts what was verified, byte for byte, into the folder `copy`, which
/// must not be there yet. The pack that is returned is the copy.
pub fn copy(folder: &Path, copy: &Path) -> Result<Checked, PackError> {
    is_folder(folder)?;
    if fs::symlink_metadata(copy).is_ok() {
        let why = "is there already; name a folder that is not, or remove it";
        return Err(PackError::at(copy)(io::Error::other(why)));
    }
    let parent = copy.parent().filter(|parent| *parent != Path::new(""));
    // Nothing stays of a pack that is refused.
    let _tidy = Tidy::new(copy);
    let scratch = Scratch::below(parent.unwrap_or(Path::new(".")));
    let scratch = scratch.map_err(|e| PackError::at(e.file)(e.source))?;
    let checked = check_one(folder, Some(scratch.path()))?;
    files::publish(scratch, copy).map_err(|e| PackError::at(e.file)(e.source))?;
    Ok(Checked { folder: copy.into(), ..checked })
}

/// Says what is there if it is no folder.
fn is_folder(path: &Path) -> Result<(), PackError> {
    let found = match fs::metadata(path) {
        Ok(there) if there.is_dir() => return Ok(()),
        Ok(there) => files::special(there.file_type()).unwrap_or("a file").to_owned(),
        Err(error) => error.to_string(),
    };
    Err(PackError::NoFolder { path: path.into(), found })
}

/// Compares what a manifest says with what is so.
struct Checker<'a> {
    folder: Folder,
    path: PathBuf,
    copy: Option<&'a Path>,
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

    /// A list that has the same entries in the same order.
    fn same_list<T: PartialEq + ToString>(
        &self,
        field: &str,
        found: impl Iterator<Item = T>,
        expected: impl Iterator<Item = T>,
    ) -> Result<(), PackError> {
        let [found, expected] = [found.collect::<Vec<T>>(), expected.collect()];
        let told = |list: &[T]| list.iter().map(T::to_string).collect::<Vec<_>>().join(", ");
        match found == expected {
            true => Ok(()),
            false => Err(self.fault(field, told(&found), told(&expected))),
        }
    }

    /// A number that is between two others.
    fn within(&self, field: &str, found: u64, least: u64, most: u64) -> Result<(), PackError> {
        match (least..=most).contains(&found) {
            true => Ok(()),
            false => Err(self.fault(field, found, format!("{least} to {most}"))),
        }
    }

    /// A text that nothing is compared with.
    fn plain(&self, field: &str, found: &str) -> Result<(), PackError> {
        fault(found).map_or(Ok(()), |expected| Err(self.fault(field, found, expected)))
    }

    /// A number with a fraction, or infinity.
    fn number(&self, field: &str, found: &str) -> Result<(), PackError> {
        match found.len() <= 40 && found.parse::<f64>().is_ok_and(|n| !n.is_nan()) {
            true => Ok(()),
            false => Err(self.fault(field, found, "a number")),
        }
    }

    fn hash(&self, field: &str, found: &str) -> Result<(), PackError> {
        match is_hash(found) {
            true => Ok(()),
            false => Err(self.fault(field, found, "64 hexadecimal digits in lower case")),
        }
    }

    /// The content of the file of that name that has the hash it should have.
    fn content(&self, field: &str, file: &HashedFile, name: &str) -> Result<Vec<u8>, PackError> {
        self.same(field, file.file.as_str(), name)?;
        self.hash(&format!("{field}.blake3"), &file.blake3)?;
        let content = self.folder.read(name, FILE_LIMIT)?;
        let hash = blake3::hash(&content).to_hex().to_string();
        if hash != file.blake3 {
            return Err(PackError::Field {
                path: self.path.with_file_name(name),
                field: format!("{field}.blake3"),
                found: format!("the file has {hash} ({} bytes)", content.len()),
                expected: file.blake3.clone(),
            });
        }
        self.keep(name, &content)?;
        Ok(content)
    }

    /// Puts what was read into the copy.
    fn keep(&self, name: &str, content: &[u8]) -> Result<(), PackError> {
        let Some(copy) = self.copy else { return Ok(()) };
        let path = copy.join(name);
        fs::write(&path, content).map_err(PackError::at(&path))
    }

    /// Verilog parameters: those that the build parameters make of the target.
    fn parameters(&self, found: &[Value], interface: &Interface) -> Result<(), PackError> {
        let names = found.iter().map(|p| p.name.as_str());
        self.same_list("parameters", names, interface.parameters.iter().map(|(name, _)| *name))?;
        found.iter().zip(&interface.parameters).try_for_each(|(found, &(name, value))| {
            self.same(&format!("parameters.{name}"), found.value, value.into())
        })
    }

    /// Names and values of static inputs or of flags.
    fn values(&self, field: &str, found: &[Value], fields: &[Field]) -> Result<(), PackError> {
        let names = found.iter().map(|value| value.name.as_str());
        self.same_list(field, names, fields.iter().map(|f| f.name))?;
        match found.iter().zip(fields).find(|(value, field)| value.value > field.mask()) {
            Some((Value { name, value }, Field { bits, .. })) => {
                Err(self.fault(&format!("{field}.{name}"), value, format!("{bits} bits at most")))
            }
            None => Ok(()),
        }
    }

    /// Names of settings, and values that are among those which each may have.
    fn settings(
        &self,
        field: &str,
        found: &[Setting],
        known: &[(&str, Vec<&str>)],
    ) -> Result<(), PackError> {
        let names = found.iter().map(|setting| setting.name.as_str());
        self.same_list(field, names, known.iter().map(|(name, _)| *name))?;
        let wrong = |(setting, (_, values)): &(&Setting, &(&str, Vec<&str>))| {
            !values.contains(&setting.value.as_str())
        };
        match found.iter().zip(known).find(wrong) {
            Some((Setting { name, value }, (_, values))) => {
                Err(self.fault(&format!("{field}.{name}"), value, values.join(" or ")))
            }
            None => Ok(()),
        }
    }

    /// The configuration that the build parameters say.
    fn build(&self, manifest: &Manifest) -> Result<Config, PackError> {
        let known: Vec<_> = PARAMETERS.iter().map(|p| (p.name, p.values.to_vec())).collect();
        self.settings("build", &manifest.build, &known)?;
        let Some(mut config) = Config::named(&manifest.config) else {
            return Err(self.fault("config", &manifest.config, Config::NAMES.join(" or ")));
        };
        for Setting { name, value } in &manifest.build {
            let set = config.set(name, value);
            set.map_err(|error| self.fault(&format!("build.{name}"), value, error))?;
        }
        Ok(config)
    }

    fn frames(&self, manifest: &Manifest, target: Target, f: &Formats) -> Result<(), PackError> {
        let has_memory = target.is_system() || target == Target::Mono;
        let Some(frames) = &manifest.frames else {
            return match has_memory {
                true => Err(self.fault("frames", "nothing", "the frame buffers")),
                false => Ok(()),
            };
        };
        if !has_memory {
            return Err(self.fault("frames", "frame buffers", "nothing: it reads none"));
        }
        // Two views may be above each other.
        let most = 2 * u64::from(f.max_size);
        self.within("frames.width", frames.width.into(), 1, most)?;
        self.within("frames.height", frames.height.into(), 1, most)?;
        self.same("frames.depth", frames.depth, DEPTH_MAX)?;
        for [left, right, top, bottom] in frames.open {
            let columns = left <= right && right <= frames.width;
            if !columns || top > bottom || bottom > frames.height {
                let found = format!("[{left}, {right}, {top}, {bottom}]");
                return Err(self.fault("frames.open", found, "a part of the frame buffer"));
            }
        }
        Ok(())
    }

    /// Checks what the manifest says of a scene, as far as that can be known without it.
    fn scene(
        &self,
        scene: &SceneOrigin,
        manifest: &Manifest,
        f: &Formats,
    ) -> Result<(), PackError> {
        self.plain("scene.name", &scene.name)?;
        if let Some(hash) = &scene.file_blake3 {
            self.hash("scene.file_blake3", hash)?;
        }
        self.hash("scene.polygons_blake3", &scene.polygons_blake3)?;
        self.within("scene.width", scene.width.into(), 1, f.max_size.into())?;
        self.within("scene.height", scene.height.into(), 1, f.max_size.into())?;
        if Kind::named(&scene.projection).is_none() {
            let names = Kind::ALL.map(Kind::name).join(" or ");
            return Err(self.fault("scene.projection", &scene.projection, names));
        }
        let rig = scene.rig.iter().map(|setting| setting.name.as_str());
        self.same_list("scene.rig", rig, origin::RIG.into_iter())?;
        for Setting { name, value } in &scene.rig {
            self.number(&format!("scene.rig.{name}"), value)?;
        }
        self.within("scene.ranges", scene.ranges.len() as u64, 1, PARTITIONS_LIMIT as u64)?;
        scene.ranges.iter().flatten().try_for_each(|n| self.number("scene.ranges", n))?;
        let run = RUN_PARAMETERS.iter().filter(|p| p.name != "latency");
        let mut known = vec![("cull", vec!["none", "back"]), ("wire", vec!["off", "on"])];
        known.extend(run.map(|p| (p.name, p.values.to_vec())));
        self.settings("scene.options", &scene.options, &known)?;
        self.within("scene.polygons", scene.polygons, 1, scene.polygons_of)?;
        self.within("scene.beats", scene.beats, 1, scene.beats_of)?;
        match manifest.ports.iter().find(|port| port.name == "beat") {
            Some(port) if matches!(&*manifest.target, "minimal" | "hybrid" | "primary") => {
                self.same("scene.beats", scene.beats, port.beats)
            }
            _ => Ok(()),
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
        let found = port.fields.iter().map(|f| f.name.as_str());
        self.same_list(&field("fields"), found, stream.fields.iter().map(|f| f.name))?;
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
        let [bin_name, mem_name] = ["bin", "mem"].map(|kind| format!("{}.{kind}", stream.name));
        let bin = self.content(&field("bin"), &port.bin, &bin_name)?;
        let (size, bytes) = (bin.len() as u64, u64::from(port.bytes));
        if size % bytes != 0 {
            let found = format!("{bin_name} of {size} bytes");
            return Err(self.fault(&field("bin"), found, "whole beats"));
        }
        self.same(&field("beats"), port.beats, size / bytes)?;
        if let Some(beat) = padded_with_ones(&bin, port.bytes as usize, port.bits) {
            let found = format!("beat {beat} of {bin_name} has ones beyond its {} bits", port.bits);
            return Err(self.fault(&field("bin"), found, "zeros there"));
        }
        self.same(&field("crc32"), port.crc32.clone(), crc32(&bin))?;
        let mem = self.content(&field("mem"), &port.mem, &mem_name)?;
        let expected = mem_text(&bin, port.bytes as usize, port.bits);
        self.text(&field("mem"), &mem_name, &mem, &expected, "the beats of the binary file")
    }

    /// Compares a file with what it must be.
    fn text(
        &self,
        field: &str,
        file: &str,
        found: &[u8],
        expected: &str,
        what: &str,
    ) -> Result<(), PackError> {
        if found == expected.as_bytes() {
            return Ok(());
        }
        let lines = found.split(|&b| b == b'\n').zip(expected.split('\n'));
        let line = 1 + lines.take_while(|(found, line)| *found == line.as_bytes()).count();
        Err(self.fault(field, format!("{file} differs at line {line}"), what))
    }

    /// The files that replay the pack.
    fn bench(&self, manifest: &Manifest, interface: &Interface) -> Result<(), PackError> {
        let files = bench::files(manifest, interface);
        let found = manifest.bench.iter().map(|file| file.file.as_str());
        self.same_list("bench", found, files.iter().map(|(file, _)| *file))?;
        let what = format!(
            "what {} generates; the pack is by {}: write it again with wheatstone vectors",
            write::GENERATOR,
            manifest.generator
        );
        for (file, (name, text)) in manifest.bench.iter().zip(&files) {
            let field = format!("bench.{name}");
            let content = self.content(&field, file, name)?;
            self.text(&field, name, &content, text, &what)?;
        }
        Ok(())
    }

    /// The manifest, of this layout.
    fn manifest(&self) -> Result<Manifest, PackError> {
        let bytes = self.folder.read(MANIFEST, MANIFEST_LIMIT)?;
        let fault = |line, column, message| PackError::Manifest {
            path: self.path.clone(),
            line,
            column,
            message,
        };
        let text = decode(&bytes)
            .map_err(|error| fault(error.line().unwrap_or(1), 1, error.to_string()))?;
        let fault = |error: serde_json::Error| {
            // The place is said in front.
            let message = error.to_string();
            let message = message.rsplit_once(" at line ").map_or(&*message, |(what, _)| what);
            fault(error.line(), error.column(), message.into())
        };
        // The version first: another layout may have fields that this one does not know.
        let value: serde_json::Value = serde_json::from_str(&text).map_err(fault)?;
        let format = value.get("format").and_then(|f| f.as_str()).unwrap_or("nothing");
        self.same("format", format, FORMAT)?;
        let schema = value.get("schema");
        let found = schema.map_or("nothing".into(), |schema| schema.to_string());
        match schema.and_then(|schema| schema.as_u64()) {
            Some(n) if n == u64::from(SCHEMA) => {}
            Some(n) if n < SCHEMA.into() => {
                let remedy = "the pack is older: write it again with wheatstone vectors";
                return Err(self.fault("schema", found, format!("{SCHEMA}; {remedy}")));
            }
            _ => {
                let remedy = "a newer pack needs a newer wheatstone";
                return Err(self.fault("schema", found, format!("{SCHEMA}; {remedy}")));
            }
        }
        self.keep(MANIFEST, &bytes)?;
        serde_json::from_str(&text).map_err(fault)
    }
}

/// True if a text names a program as this one does, with any version.
fn is_generator(text: &str) -> bool {
    let version = text.strip_prefix("wheatstone ").filter(|version| version.len() <= 40);
    let is_part = |b: u8| b.is_ascii_alphanumeric() || b"+-.".contains(&b);
    version.is_some_and(|version| !version.is_empty() && version.bytes().all(is_part))
}

fn check_one(folder: &Path, copy: Option<&Path>) -> Result<Checked, PackError> {
    let path = folder.join(MANIFEST);
    let checker = Checker { folder: Folder::open(folder)?, path, copy };
    let manifest = checker.manifest()?;
    if !is_generator(&manifest.generator) {
        return Err(checker.fault("generator", &manifest.generator, "wheatstone and a version"));
    }
    let target = Target::named(&manifest.target).ok_or_else(|| {
        checker.fault("target", &manifest.target, "a target that `wheatstone list` names")
    })?;
    checker.same("module", manifest.module.as_str(), target.module())?;
    checker.plain("case", &manifest.case)?;
    let config = checker.build(&manifest)?;
    let interface = target.interface(&config);
    checker.parameters(&manifest.parameters, &interface)?;
    checker.values("statics", &manifest.statics, &interface.statics)?;
    checker.values("flags", &manifest.flags, &interface.flags)?;
    let f = target.formats(&config);
    checker.frames(&manifest, target, &f)?;
    match (&*manifest.stimulus, &manifest.scene) {
        ("scene", Some(scene)) => checker.scene(scene, &manifest, &f)?,
        ("random" | "directed", None) => {}
        (found, _) => {
            return Err(checker.fault("stimulus", found, "random, directed, or scene with a scene"))
        }
    }
    consistent::check(&checker.path, &manifest, target, &config)
        .map_err(|wrong| checker.fault(&wrong.field, wrong.found, wrong.expected))?;
    checker.hash("rtl_blake3", &manifest.rtl_blake3)?;
    let found = manifest.ports.iter().map(|p| p.name.as_str());
    checker.same_list("ports", found, interface.streams.iter().map(|s| s.name))?;
    for (port, stream) in manifest.ports.iter().zip(&interface.streams) {
        checker.port(port, stream)?;
    }
    checker.same("hash", manifest.hash.clone(), manifest.digest())?;
    checker.bench(&manifest, &interface)?;
    let streams = manifest.ports.iter().flat_map(|port| [&port.bin, &port.mem]);
    let files = streams.chain(&manifest.bench).map(|file| file.file.as_str());
    let names: Vec<&str> = files.chain([MANIFEST]).collect();
    if let Some(file) = checker.folder.other_than(&names)? {
        return Err(PackError::Extra { path: folder.into(), file });
    }
    if manifest.is_vain() {
        return Err(PackError::Vain { path: folder.into() });
    }
    Ok(Checked { folder: folder.into(), manifest, interface })
}
