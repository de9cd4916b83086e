//! Models are built when something changed and only then, and errors say what to do.

mod common;

use common::*;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::Arc;
use wheatstone_golden::interface::Interface;
use wheatstone_testbench::tools::{ToolError, Toolchain};
use wheatstone_testbench::{
    Bench, BuildError, Builder, Job, Library, PortError, Probe, Progress, Spec,
};

/// A builder that counts the models it builds.
struct Counting {
    builder: Builder,
    built: Arc<AtomicUsize>,
}

impl Counting {
    fn new(cache: &Path) -> Counting {
        let built = Arc::new(AtomicUsize::new(0));
        let counter = built.clone();
        let builder = Builder::new(Toolchain::find().unwrap(), cache);
        let builder = builder.on_progress(move |progress| {
            if let Progress::Building(module) = progress {
                assert!(progress.to_string().starts_with(&format!("building {module}")));
                counter.fetch_add(1, Ordering::SeqCst);
            }
        });
        Counting { builder, built }
    }

    fn build(&self, interface: &Interface, rtl: &Path) -> Result<Library, BuildError> {
        self.builder.build(&Spec { interface, rtl, probes: &[] })
    }

    fn built(&self) -> usize {
        self.built.load(Ordering::SeqCst)
    }
}

/// A copy of the fixtures that a test may change.
fn copied() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for entry in fs::read_dir(fixtures()).unwrap() {
        let entry = entry.unwrap();
        fs::copy(entry.path(), folder.path().join(entry.file_name())).unwrap();
    }
    folder
}

fn edit(folder: &Path, file: &str, from: &str, to: &str) {
    let path = folder.join(file);
    let text = fs::read_to_string(&path).unwrap();
    assert!(text.contains(from), "{from} is not in {file}");
    fs::write(path, text.replace(from, to)).unwrap();
}

fn passes(library: &Library) -> bool {
    let sums = sums(200, 1);
    let chain = library.interface().target == "chain";
    let expected = if chain { &sums.second_sum } else { &sums.sum };
    let tables = [Some(&sums.term), Some(expected)];
    let job = Job { statics: &[BIAS], tables: &tables, ..Job::default() };
    Bench::new(library, 1).unwrap().run(&job).unwrap().passed().is_some()
}

#[test]
fn a_model_is_built_once_and_again_when_its_source_changed() {
    let (cache, rtl) = (fresh_cache(), copied());
    let counting = Counting::new(cache.path());
    let interface = chain(0);
    assert!(passes(&counting.build(&interface, rtl.path()).unwrap()));
    assert_eq!(counting.built(), 1);
    assert!(passes(&counting.build(&interface, rtl.path()).unwrap()));
    assert_eq!(counting.built(), 1, "nothing changed");

    edit(rtl.path(), "sam_reader.v", "head_q", "top_q");
    assert!(passes(&counting.build(&interface, rtl.path()).unwrap()));
    assert_eq!(counting.built(), 1, "a module that this one does not use changed");

    edit(rtl.path(), "sam_adder.v", "a + b + c", "a - b + c");
    assert!(!passes(&counting.build(&interface, rtl.path()).unwrap()), "yesterday's model");
    assert_eq!(counting.built(), 2, "a module below changed");

    edit(rtl.path(), "sam_adder.v", "a - b + c;", "a + b + c;");
    assert!(passes(&counting.build(&interface, rtl.path()).unwrap()));
    assert_eq!(counting.built(), 2, "the first text again");

    assert!(counting.build(&chain(1), rtl.path()).is_ok());
    assert_eq!(counting.built(), 3, "another parameter");
}

#[test]
fn many_askers_get_one_build() {
    let (cache, rtl) = (fresh_cache(), copied());
    let counting: Vec<Counting> = (0..4).map(|_| Counting::new(cache.path())).collect();
    // What a killed build leaves behind does not disturb, and goes.
    let interface = adder(0);
    let library = counting[0].build(&interface, rtl.path()).unwrap();
    drop(library);
    let folders = fs::read_dir(cache.path()).unwrap().map(|e| e.unwrap().path());
    let is_model = |p: &std::path::PathBuf| p.join("model.so").is_file();
    let folder = folders.into_iter().find(is_model).unwrap();
    let left = cache.path().join(".wheatstone-left.part");
    fs::rename(&folder, &left).unwrap();
    std::thread::scope(|scope| {
        for counting in &counting {
            scope.spawn(|| assert!(passes(&counting.build(&interface, rtl.path()).unwrap())));
        }
    });
    let built: usize = counting.iter().map(Counting::built).sum();
    assert_eq!(built, 2, "the first and one of the four");
    assert!(!left.exists());
}

#[test]
fn ports_must_be_those_of_the_interface() {
    let cache = fresh_cache();
    let counting = Counting::new(cache.path());
    let build = |change: fn(&mut Interface)| {
        let mut interface = adder(0);
        change(&mut interface);
        match counting.build(&interface, &fixtures()) {
            Err(BuildError::Port { file, source }) => {
                assert_eq!(file, fixtures().join("sam_adder.v"));
                source
            }
            other => panic!("{:?}", other.map(|_| ())),
        }
    };
    let error = build(|i| i.streams[0].fields[1].bits = 24);
    assert_eq!(
        error.to_string(),
        "port term_a_i of module sam_adder has 25 bits, its interface says 24"
    );
    let error = build(|i| i.streams[1].name = "total");
    assert!(matches!(error, PortError::Missing { port, .. } if port == "total_valid_o"));
    let error = build(|i| i.statics.clear());
    assert!(matches!(error, PortError::Unknown { port, found: 25, .. } if port == "bias_i"));
}

#[test]
fn what_the_tools_say_is_shown_and_kept() {
    let (cache, rtl) = (fresh_cache(), copied());
    let counting = Counting::new(cache.path());
    let failed = |interface: &Interface| match counting.build(interface, rtl.path()) {
        Err(BuildError::Failed { tool, lines, log, .. }) => (tool, lines, log),
        other => panic!("{:?}", other.map(|_| ())),
    };
    let mut interface = adder(0);
    interface.parameters.push(("DEPTH", 3));
    let (tool, lines, log) = failed(&interface);
    assert_eq!(tool, "verilator");
    assert!(lines.contains("DEPTH"), "{lines}");
    assert!(fs::read_to_string(log).unwrap().contains("DEPTH"));

    edit(rtl.path(), "sam_adder.v", "assign error_o = error_q;", "assign error_o = error_q");
    let (_, lines, _) = failed(&adder(0));
    let place = format!("%Error: {}/sam_adder.v:", rtl.path().display());
    assert!(lines.starts_with(&place), "{lines}");

    let error = counting.build(&adder(0), Path::new("/nonexistent")).err().unwrap().to_string();
    assert!(error.contains("cannot read /nonexistent: No such file"), "{error}");
    fs::remove_file(rtl.path().join("sam_adder.v")).unwrap();
    let error = counting.build(&adder(0), rtl.path()).err().unwrap().to_string();
    assert!(error.contains("sam_adder.v: No such file"), "{error}");
}

#[test]
fn a_probe_that_is_not_there_is_named() {
    let cache = fresh_cache();
    let counting = Counting::new(cache.path());
    let wrong = [Probe::new("u_third", &adder(0))];
    let interface = chain(0);
    let spec = Spec { interface: &interface, rtl: &fixtures(), probes: &wrong };
    let library = counting.builder.build(&spec).unwrap();
    let error = Bench::new(&library, 1).err().unwrap().to_string();
    assert_eq!(error, "module sam_chain does not start: no instance TOP.sam_chain.u_third");
}

#[test]
fn a_missing_verilator_is_one_message_with_the_command() {
    let error = Toolchain::find_in(OsStr::new("/nonexistent")).unwrap_err();
    assert!(matches!(error, ToolError::Missing(_)));
    assert_eq!(
        error.to_string(),
        "verilator is not installed; it is needed for co-simulation; \
         install it with: apt-get install verilator"
    );
    let error = BuildError::from(error).to_string();
    assert!(error.ends_with("apt-get install verilator"), "{error}");
}

#[test]
fn a_cache_that_cannot_be_written_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file");
    fs::write(&file, "").unwrap();
    let error = Counting::new(&file).build(&adder(0), &fixtures()).err().unwrap();
    assert!(matches!(error, BuildError::Cache { .. }));
    assert!(error.to_string().starts_with("cannot write "), "{error}");
}

/// The folders of a cache whose names begin so.
fn kept(cache: &Path, name: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(cache).unwrap().map(|entry| entry.unwrap().path());
    let is_it = |path: &PathBuf| path.file_name().unwrap().to_string_lossy().starts_with(name);
    entries.filter(|path| path.is_dir() && is_it(path)).collect()
}

#[test]
fn what_was_changed_in_the_cache_is_built_again() {
    let cache = fresh_cache();
    let counting = Counting::new(cache.path());
    let interface = adder(0);
    let library = counting.build(&interface, &fixtures()).unwrap();
    let object = kept(cache.path(), "sam_adder")[0].join("model.so");
    // Those of older versions are there too.
    let runtimes = kept(cache.path(), "runtime").into_iter().map(|path| path.join("verilated.o"));
    let runtimes: Vec<PathBuf> = runtimes.collect();
    let sound = fs::read(&object).unwrap();
    fs::write(&object, &sound[..sound.len() / 2]).unwrap();
    runtimes.iter().for_each(|file| fs::write(file, "").unwrap());
    assert!(passes(&counting.build(&interface, &fixtures()).unwrap()));
    assert_eq!(counting.built(), 2);
    assert_eq!(fs::read(&object).unwrap().len(), sound.len());
    let sound = runtimes.iter().filter(|file| !fs::read(file).unwrap().is_empty());
    assert_eq!(sound.count(), 1);
    // One that is in use is a copy of its own.
    fs::write(&object, "").unwrap();
    assert!(passes(&library));
    assert_eq!(kept(cache.path(), ".wheatstone"), Vec::<PathBuf>::new());
    // What cannot be replaced is named before anything is built.
    let folder = object.parent().unwrap();
    fs::remove_dir_all(folder).unwrap();
    fs::write(folder, "").unwrap();
    let error = counting.build(&interface, &fixtures()).err().unwrap().to_string();
    assert!(error.contains(&folder.display().to_string()), "{error}");
    assert!(error.ends_with("expected a folder, found a file; delete it"), "{error}");
}

/// A compiler that says that all is well. In place of objects of the runtime and of models it makes what the words of
/// a shell write to `$out`.
fn false_compiler(objects: &str, models: &str) -> (tempfile::TempDir, Toolchain) {
    let folder = tempfile::tempdir().unwrap();
    let mut tools = Toolchain::find().unwrap();
    let program = folder.path().join("g++");
    let script = format!(
        "#!/bin/sh\nfor out; do test \"$last\" = -o && break; last=$out; done\n\
         case $out in *.so) {models};; *.o) {objects};; *) exec {} \"$@\";; esac\n",
        tools.gxx.program.display()
    );
    // Written by a process that ends before it is run: one that is open cannot be run.
    let mut shell = std::process::Command::new("sh");
    shell.args(["-c", "printf %s \"$1\" >$2 && chmod +x $2", "sh", &script]).arg(&program);
    assert!(shell.status().unwrap().success());
    tools.gxx.program = program;
    (folder, tools)
}

#[test]
fn a_compiler_that_succeeds_without_a_model_is_an_error_that_leaves_nothing() {
    let runtime = fresh_cache();
    let objects = kept(runtime.path(), "runtime").remove(0);
    let objects = format!("cp {}/$out .", objects.display());
    for (objects, models, found) in [
        (":", ":", "wrote no verilated.o"),
        (">$out", ":", "wrote only a part of verilated.o"),
        (objects.as_str(), ":", "wrote no model.so"),
        (&objects, "head -c 1000 /bin/sh >$out", "wrote only a part of model.so"),
        (&objects, "cp /bin/sh $out", "cannot load"),
    ] {
        let cache = tempfile::tempdir().unwrap();
        let (_folder, tools) = false_compiler(objects, models);
        let builder = Builder::new(tools, cache.path());
        let interface = adder(0);
        let spec = Spec { interface: &interface, rtl: &fixtures(), probes: &[] };
        let error = builder.build(&spec).err().expect("an error").to_string();
        assert!(error.contains(found), "{found}: {error}");
        for left in ["sam_", ".wheatstone"] {
            assert_eq!(kept(cache.path(), left), Vec::<PathBuf>::new(), "{found}");
        }
    }
}
