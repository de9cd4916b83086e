//! No source file imports another one that imports it, by whatever way round.

use petgraph::algo::tarjan_scc;
use petgraph::graphmap::DiGraphMap;
use proc_macro2::{TokenStream, TokenTree};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use syn::{Item, UseTree, Visibility};
use wheatstone_tests::workspace;

/// A path in the source, as `["crate", "scene", "Scene"]`; of a glob, what stands before the `*`.
type Names = Vec<String>;

/// A module that has a file of its own.
#[derive(Default)]
struct Module {
    file: PathBuf,
    /// Modules inside, with or without a file.
    children: BTreeSet<String>,
    /// Items that are defined here.
    items: BTreeSet<String>,
    /// Imported names and where they come from.
    imports: BTreeMap<String, Names>,
    /// Modules whose names are all imported.
    globs: Vec<Names>,
    /// Paths that stand in the code.
    used: BTreeSet<Names>,
}

/// The modules of a crate by their path; the root has none.
#[derive(Default)]
struct Crate(BTreeMap<Names, Module>);

impl Crate {
    /// Reads a file and those of the modules that it declares, without tests.
    fn read(&mut self, file: &Path, path: Names, folder: &Path) {
        let text = fs::read_to_string(file).expect("a source file");
        let syntax = syn::parse_file(&text).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
        let mut module = Module { file: file.to_owned(), ..Module::default() };
        for item in syntax.items {
            self.item(&mut module, item, &path, folder);
        }
        self.0.insert(path, module);
    }

    fn item(&mut self, module: &mut Module, item: Item, path: &Names, folder: &Path) {
        let tokens = quote::quote!(#item);
        let (name, attributes) = match &item {
            Item::Mod(i) => (Some(i.ident.to_string()), &i.attrs),
            Item::Use(i) => (None, &i.attrs),
            Item::Struct(i) => (Some(i.ident.to_string()), &i.attrs),
            Item::Enum(i) => (Some(i.ident.to_string()), &i.attrs),
            Item::Fn(i) => (Some(i.sig.ident.to_string()), &i.attrs),
            Item::Trait(i) => (Some(i.ident.to_string()), &i.attrs),
            Item::Type(i) => (Some(i.ident.to_string()), &i.attrs),
            Item::Const(i) => (Some(i.ident.to_string()), &i.attrs),
            Item::Static(i) => (Some(i.ident.to_string()), &i.attrs),
            Item::Macro(i) => (i.ident.as_ref().map(ToString::to_string), &i.attrs),
            Item::Impl(i) => (None, &i.attrs),
            _ => return,
        };
        let is_test = |a: &syn::Attribute| quote::quote!(#a).to_string().contains("cfg (test)");
        if attributes.iter().any(is_test) {
            return;
        }
        match item {
            Item::Mod(declared) if declared.content.is_none() => {
                let name = declared.ident.to_string();
                let beside = folder.join(format!("{name}.rs"));
                let inside = folder.join(&name);
                let file = if beside.exists() { beside } else { inside.join("mod.rs") };
                self.read(&file, [path.as_slice(), std::slice::from_ref(&name)].concat(), &inside);
                module.children.insert(name);
            }
            Item::Use(import) => {
                let mut found = Vec::new();
                flatten(&import.tree, &[], &mut found);
                for (name, names) in found {
                    match name {
                        Some(name) => {
                            // A name that is handed on is no use of what it stands for.
                            if matches!(import.vis, Visibility::Inherited) {
                                module.used.insert(names.clone());
                            }
                            module.imports.insert(name, names);
                        }
                        None => module.globs.push(names),
                    }
                }
            }
            _ => {
                module.items.extend(name);
                paths(tokens, &mut module.used);
            }
        }
    }

    /// The module that defines what a path in a module names, if it is one of this crate.
    fn definition(&self, from: &Names, names: &[String], depth: usize) -> Option<Names> {
        let (first, rest) = names.split_first()?;
        let module = self.0.get(from)?;
        if depth == 0 {
            return None;
        }
        let next = match first.as_str() {
            "crate" => Vec::new(),
            "self" => from.clone(),
            "super" => from[..from.len().checked_sub(1)?].to_vec(),
            name if module.children.contains(name) => [from.as_slice(), &[name.into()]].concat(),
            name if module.items.contains(name) => return Some(from.clone()),
            name => {
                if let Some(import) = module.imports.get(name) {
                    let whole = [import.as_slice(), rest].concat();
                    let is_itself = import.first().is_some_and(|f| f == name);
                    return (!is_itself).then(|| self.definition(from, &whole, depth - 1))?;
                }
                return module.globs.iter().find_map(|glob| {
                    let whole = [glob.as_slice(), names].concat();
                    self.definition(from, &whole, depth - 1)
                });
            }
        };
        match rest {
            [] => None,
            _ => self.definition(&next, rest, depth - 1),
        }
    }

    /// Groups of files that import one another, with a name for each import.
    fn cycles(&self) -> Vec<Vec<(&Path, &Path, String)>> {
        let mut graph = DiGraphMap::<&Path, &Names>::new();
        for (path, module) in &self.0 {
            for names in &module.used {
                if let Some(other) = self.definition(path, names, 16).filter(|o| o != path) {
                    graph.add_edge(&module.file, &self.0[&other].file, names);
                }
            }
        }
        let groups = tarjan_scc(&graph).into_iter().filter(|group| group.len() > 1);
        let inside = |group: Vec<&Path>| {
            let edges = graph.all_edges().map(|(from, to, names)| (from, to, names.join("::")));
            edges.filter(|(from, to, _)| group.contains(from) && group.contains(to)).collect()
        };
        groups.map(inside).collect()
    }
}

/// Names that an import brings and their paths; none for a glob.
fn flatten(tree: &UseTree, before: &[String], found: &mut Vec<(Option<String>, Names)>) {
    let with = |name: String| [before, &[name]].concat();
    match tree {
        UseTree::Path(path) => flatten(&path.tree, &with(path.ident.to_string()), found),
        UseTree::Group(group) => group.items.iter().for_each(|tree| flatten(tree, before, found)),
        UseTree::Glob(_) => found.push((None, before.to_vec())),
        UseTree::Name(name) if name.ident == "self" => {
            found.push((before.last().cloned(), before.to_vec()));
        }
        UseTree::Name(name) => {
            found.push((Some(name.ident.to_string()), with(name.ident.to_string())))
        }
        UseTree::Rename(name) if name.ident == "self" => {
            found.push((Some(name.rename.to_string()), before.to_vec()));
        }
        UseTree::Rename(name) => {
            found.push((Some(name.rename.to_string()), with(name.ident.to_string())));
        }
    }
}

/// All paths in code, also in what is handed to macros.
fn paths(tokens: TokenStream, found: &mut BTreeSet<Names>) {
    let mut names = Names::new();
    let mut colons = 0;
    for token in tokens {
        match token {
            TokenTree::Ident(ident) => {
                if colons != 2 && !names.is_empty() {
                    found.insert(std::mem::take(&mut names));
                }
                names.push(ident.to_string());
                colons = 0;
                continue;
            }
            TokenTree::Punct(p) if p.as_char() == ':' => {
                colons += 1;
                continue;
            }
            TokenTree::Group(group) => paths(group.stream(), found),
            _ => {}
        }
        colons = 0;
        if !names.is_empty() {
            found.insert(std::mem::take(&mut names));
        }
    }
    if !names.is_empty() {
        found.insert(names);
    }
}

#[test]
fn no_file_imports_one_that_imports_it() {
    let mut cycles = String::new();
    for name in ["fuzz", "golden", "process", "studies", "testbench"] {
        let folder = workspace().join(name).join("src");
        let mut modules = Crate::default();
        modules.read(&folder.join("lib.rs"), Names::new(), &folder);
        assert!(modules.0.len() > 1, "{name}");
        for group in modules.cycles() {
            let short =
                |file: &Path| file.strip_prefix(&folder).unwrap_or(file).display().to_string();
            let line =
                |(from, to, names)| format!("  {} uses {} of {}\n", short(from), names, short(to));
            let mut lines: Vec<_> = group.into_iter().map(line).collect();
            lines.sort();
            cycles += &format!("{name}:\n{}", lines.concat());
        }
    }
    assert!(cycles.is_empty(), "files import one another:\n{cycles}");
}
