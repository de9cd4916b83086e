//! The builds of a module that are proved.

use crate::flow;
use crate::sources::Sources;
use wheatstone_golden::config::Config;
use wheatstone_golden::targets::Target;

/// A module with parameters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Build {
    /// Module without `sam_`.
    pub module: String,
    /// The named configurations that give these parameters, or what else the build is for.
    pub label: String,
    /// Verilog parameters that are set.
    pub parameters: Vec<(String, u32)>,
}

impl Build {
    /// The builds of a module with this Verilog: those of the named configurations, each set of parameters once,
    /// then the others.
    pub(super) fn all(module: &str, text: &str) -> Vec<Build> {
        let mut builds: Vec<Build> = Vec::new();
        for name in Config::NAMES {
            let config = Config::named(name).unwrap_or(Config::DEFAULT);
            let parameters = parameters(module, text, &config);
            match builds.iter_mut().find(|build| build.parameters == parameters) {
                Some(build) => build.label = format!("{}, {name}", build.label),
                None => builds.push(Build {
                    module: module.to_owned(),
                    label: name.to_owned(),
                    parameters,
                }),
            }
        }
        for (_, label, parameters) in VARIANTS.iter().filter(|(of, ..)| *of == module) {
            let parameters = parameters.iter().map(|(n, v)| ((*n).to_owned(), *v)).collect();
            let (module, label) = (module.to_owned(), (*label).to_owned());
            builds.push(Build { module, label, parameters });
        }
        builds
    }

    /// Yosys commands that read a build, its own properties included.
    pub(super) fn read_commands(&self, sources: &Sources) -> String {
        let module = format!("sam_{}", self.module);
        let own = format!("{module}.v");
        let others = sources.keys().filter(|name| name.ends_with(".v") && **name != own);
        let others: String = others.map(|name| format!(" {name}")).collect();
        let plain = match others.is_empty() {
            true => others,
            false => format!("read_verilog -I .{others}; "),
        };
        let set = flow::set_parameters(&module, &self.parameters);
        // Tables must not become memories that begin with anything.
        format!(
            "{plain}read_verilog -formal -I . {own}; {set}prep -top {module} -flatten; rename -top {module}; \
             memory_map; opt_clean; async2sync; dffunmap"
        )
    }
}

/// Module, label and parameters of a build.
type Variant = (&'static str, &'static str, &'static [(&'static str, u32)]);

/// Builds beside those of the named configurations: narrow ones, where wide ones would take too long,
/// and ones that the systems use.
const VARIANTS: [Variant; 13] = [
    ("filter_division", "three terms", &[("FILTER_TERMS", 3)]),
    ("edge_interpolator", "3 bits", &[("BITS", 3), ("SLOPE_BITS", 2), ("TILT", 1)]),
    ("edge_interpolator", "depth", &[("BITS", 43), ("SLOPE_BITS", 43), ("TILT", 0)]),
    ("clamp", "depth", &[("BITS", 24)]),
    ("stage", "40 bits", &[("WIDTH", 40)]),
    ("buffer", "40 bits", &[("WIDTH", 40)]),
    ("polygon", "minimal", &[("SUBPIXEL_BITS", 8), ("LEND", 0)]),
    ("slot_queue", "2 slots", &[("SUBPIXEL_BITS", 4), ("SLOTS", 2)]),
    ("slot_queue", "8 slots", &[("SUBPIXEL_BITS", 4), ("SLOTS", 8)]),
    ("hybrid_back", "8 slots", EIGHT_SLOTS),
    ("hybrid", "8 slots", EIGHT_SLOTS_FILTERED),
    ("mono", "8 slots", &[("SUBPIXEL_BITS", 4), ("SLOTS", 8)]),
    ("stereo", "8 slots", EIGHT_SLOTS_FILTERED),
];

/// The architecture of many slots with as few of them and as little else as there can be.
const EIGHT_SLOTS: &[(&str, u32)] =
    &[("SUBPIXEL_BITS", 4), ("DEPTH_INTERPOLATED", 0), ("SLOTS", 8)];
/// The same of what has a filter.
const EIGHT_SLOTS_FILTERED: &[(&str, u32)] =
    &[("SUBPIXEL_BITS", 4), ("FILTER_TERMS", 2), ("DEPTH_INTERPOLATED", 0), ("SLOTS", 8)];

/// The parameters of a module in a configuration.
fn parameters(module: &str, text: &str, config: &Config) -> Vec<(String, u32)> {
    let own = |(name, value): (&str, u32)| (name.to_owned(), value);
    match Target::named(module) {
        Some(target) => target.interface(config).parameters.into_iter().map(own).collect(),
        None => {
            let lines = text.lines().filter_map(|line| line.trim().strip_prefix("parameter "));
            let names = lines.filter_map(|line| line.split(' ').next());
            names.filter_map(|name| Some(own((name, config.get(name)?)))).collect()
        }
    }
}
