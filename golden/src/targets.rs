//! Targets of simulation: the units and the systems, and their interfaces.

use crate::config::Config;
use crate::formats::*;
use crate::interface::{Bits, Interface, Stream};
use crate::pipeline::observer::Unit;
use crate::pipeline::{
    blend, coverage, display, edge_interpolator, filter, redirect, sampler, traversal,
    x_interpolator, y_interpolator, Edges, Pixel, Planes, PrimaryBeat, Request, Response, Setup,
    Walk,
};
use crate::stereo::Job;

/// A unit or a system.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Target {
    /// X interpolator.
    XInterpolator,
    /// Y interpolator.
    YInterpolator,
    /// Edge-function interpolator.
    EdgeInterpolator,
    /// Point sampler.
    Sampler,
    /// Box filter.
    Filter,
    /// Pixel coverage.
    Coverage,
    /// Blending.
    Blend,
    /// Display placement.
    Display,
    /// Pixel redirection.
    Redirect,
    /// Traversal of the primary pipeline.
    Traversal,
    /// Primary pipeline.
    Primary,
    /// Monocular pipeline.
    Mono,
    /// Minimal system.
    Minimal,
    /// Hybrid system.
    Hybrid,
    /// Primary pipeline and hybrid system.
    Stereo,
}

impl Target {
    /// All targets, units first, in the order of the pipeline.
    pub const ALL: [Target; 15] = [
        Target::XInterpolator,
        Target::YInterpolator,
        Target::EdgeInterpolator,
        Target::Display,
        Target::Sampler,
        Target::Filter,
        Target::Coverage,
        Target::Blend,
        Target::Redirect,
        Target::Traversal,
        Target::Primary,
        Target::Mono,
        Target::Minimal,
        Target::Hybrid,
        Target::Stereo,
    ];

    /// Name on the command line and of model, test and page.
    pub fn name(self) -> &'static str {
        match self {
            Target::XInterpolator => "x_interpolator",
            Target::YInterpolator => "y_interpolator",
            Target::EdgeInterpolator => "edge_interpolator",
            Target::Sampler => "sampler",
            Target::Filter => "filter",
            Target::Coverage => "coverage",
            Target::Blend => "blend",
            Target::Display => "display",
            Target::Redirect => "redirect",
            Target::Traversal => "traversal",
            Target::Primary => "primary",
            Target::Mono => "mono",
            Target::Minimal => "minimal",
            Target::Hybrid => "hybrid",
            Target::Stereo => "stereo",
        }
    }

    /// The target of that name.
    pub fn named(name: &str) -> Option<Target> {
        Target::ALL.into_iter().find(|t| t.name() == name)
    }

    /// Its line in `wheatstone list`.
    pub fn purpose(self) -> &'static str {
        match self {
            Target::XInterpolator => {
                "secondary x of every primary pixel, and its whole-pixel movement"
            }
            Target::YInterpolator => "display row of the secondary; affine y with a tilted head",
            Target::EdgeInterpolator => {
                "edge function (or depth, or colour) at whole secondary pixels"
            }
            Target::Sampler => "nearest primary pixel of a secondary pixel",
            Target::Filter => "average of the primary pixels in a secondary pixel",
            Target::Coverage => "samples of a secondary pixel inside the three edges",
            Target::Blend => "colour over background by coverage and alpha",
            Target::Display => "where a secondary pixel goes on the display",
            Target::Redirect => "primary and secondary pixels to their eyes",
            Target::Traversal => "pixels of a polygon, scan line by scan line",
            Target::Primary => "beats of the primary pipeline from register values",
            Target::Mono => "primary pipeline with depth test and blending, for one eye",
            Target::Minimal => "system: interpolation and sampling only",
            Target::Hybrid => "system: edges, filter, coverage, depth test and blending",
            Target::Stereo => "system: primary pipeline and hybrid, from register values to pixels",
        }
    }

    /// True if it is a complete system.
    pub fn is_system(self) -> bool {
        matches!(self, Target::Minimal | Target::Hybrid | Target::Stereo)
    }

    /// A job as the target can draw it: without textures, if it makes the primary's colours itself.
    pub fn job<'a>(self, job: &'a Job) -> Job<'a> {
        match self {
            Target::Traversal | Target::Primary | Target::Mono | Target::Stereo => job.untextured(),
            _ => job.clone(),
        }
    }

    /// The Verilog module.
    pub fn module(self) -> &'static str {
        match self {
            Target::XInterpolator => "sam_x_interpolator",
            Target::YInterpolator => "sam_y_interpolator",
            Target::EdgeInterpolator => "sam_edge_interpolator",
            Target::Sampler => "sam_sampler",
            Target::Filter => "sam_filter",
            Target::Coverage => "sam_coverage",
            Target::Blend => "sam_blend",
            Target::Display => "sam_display",
            Target::Redirect => "sam_redirect",
            Target::Traversal => "sam_traversal",
            Target::Primary => "sam_primary",
            Target::Mono => "sam_mono",
            Target::Minimal => "sam_minimal",
            Target::Hybrid => "sam_hybrid",
            Target::Stereo => "sam_stereo",
        }
    }

    /// The number formats of the target in a configuration.
    pub fn formats(self, config: &Config) -> Formats {
        match self {
            Target::Minimal => Formats::minimal(config),
            _ => Formats::new(config),
        }
    }

    /// The interface in a configuration.
    pub fn interface(self, config: &Config) -> Interface {
        let f = &self.formats(config);
        let parameter = |name: &'static str| (name, config.get(name).unwrap_or_default());
        let parameters = |names: &[&'static str]| names.iter().copied().map(parameter).collect();
        let width = Coordinate::field("width", "columns of a view", f);
        let height = Coordinate::field("height", "rows of a view", f);
        let single = bool::field("single", "both eyes to one display, stream left", f);
        let clear = bool::field("error_clear", "clears the error flag", f);
        let error = bool::field("error", "a polygon or beat was refused since the last clear", f);
        let mut interface = Interface {
            target: self.name(),
            module: self.module(),
            parameters: Vec::new(),
            statics: Vec::new(),
            streams: self.streams(f),
            flags: Vec::new(),
        };
        match self {
            Target::XInterpolator => {
                interface.parameters = parameters(&["SUBPIXEL_BITS"]);
                interface.statics = vec![width];
            }
            Target::YInterpolator => {
                interface.parameters = parameters(&["SUBPIXEL_BITS", "TILT"]);
                interface.statics = vec![height];
            }
            Target::EdgeInterpolator => {
                let widths = [("BITS", f.edge_bits), ("SLOPE_BITS", f.slope_bits)];
                interface.parameters = widths.into_iter().chain([parameter("TILT")]).collect();
            }
            Target::Sampler => interface.parameters = vec![("WIDTH", f.sample_bits)],
            Target::Filter => interface.parameters = parameters(&["FILTER_TERMS"]),
            Target::Coverage => interface.parameters = parameters(&["SUBPIXEL_BITS", "ANTIALIAS"]),
            Target::Blend => {
                interface.parameters = parameters(&["ANTIALIAS"]);
                interface.parameters.push(("TAG_BITS", Tag::bits(f)));
            }
            Target::Display => {
                interface.parameters = parameters(&["SUBPIXEL_BITS"]);
                interface.statics = vec![width];
            }
            Target::Redirect => {
                interface.parameters = parameters(&["SUBPIXEL_BITS", "ANTIALIAS"]);
                interface.statics = vec![single];
            }
            Target::Minimal => {
                interface.parameters = parameters(&["SUBPIXEL_BITS", "ANTIALIAS", "TILT"]);
                interface.statics = vec![width, height, single, clear];
                interface.flags = vec![error];
            }
            Target::Traversal => interface.parameters = parameters(&["SUBPIXEL_BITS"]),
            Target::Primary => {
                interface.parameters = parameters(&["SUBPIXEL_BITS", "ANTIALIAS"]);
                interface.statics = vec![width];
            }
            Target::Mono => {
                interface.parameters =
                    parameters(&["SUBPIXEL_BITS", "ANTIALIAS", "DEPTH_EXTERNAL", "SLOTS"]);
                interface.statics = vec![width, Eye::field("eye", "whose view is drawn", f)];
            }
            Target::Hybrid | Target::Stereo => {
                interface.parameters =
                    crate::config::PARAMETERS.iter().map(|p| parameter(p.verilog)).collect();
                interface.statics = vec![width, height, single, clear];
                interface.flags = vec![error];
            }
        }
        interface
    }

    fn streams(self, f: &Formats) -> Vec<Stream> {
        match self {
            Target::XInterpolator => vec![
                Stream::input::<x_interpolator::XBeat>("beat", f),
                Stream::output::<x_interpolator::XPixel>("pixel", f),
            ],
            Target::YInterpolator => vec![
                Stream::input::<y_interpolator::YBeat>("beat", f),
                Stream::output::<y_interpolator::YPixel>("pixel", f),
            ],
            Target::EdgeInterpolator => vec![
                Stream::input::<edge_interpolator::EdgeBeat>("beat", f),
                Stream::output::<edge_interpolator::EdgeOutput>("value", f),
            ],
            Target::Sampler => vec![
                Stream::input::<sampler::SamplerBeat>("beat", f),
                Stream::output::<sampler::Sample>("sample", f),
            ],
            Target::Filter => vec![
                Stream::input::<filter::FilterBeat>("beat", f),
                Stream::output::<filter::FilterPixel>("pixel", f),
            ],
            Target::Coverage => vec![
                Stream::input::<coverage::CoverageEdges>("edges", f),
                Stream::output::<coverage::CoveragePixel>("coverage", f),
            ],
            Target::Blend => vec![
                Stream::input::<blend::BlendPixel>("pixel", f),
                Stream::output::<blend::BlendColour>("colour", f),
            ],
            Target::Display => vec![
                Stream::input::<display::DisplayPoint>("point", f),
                Stream::output::<display::DisplayPixel>("pixel", f),
            ],
            Target::Redirect => vec![
                Stream::input::<redirect::Slot>("slot", f),
                Stream::output::<Pixel>("left", f),
                Stream::output::<Pixel>("right", f),
            ],
            Target::Traversal => vec![
                Stream::input::<Walk>("walk", f),
                Stream::output::<traversal::Visit>("visit", f),
            ],
            Target::Primary => vec![
                Stream::input::<Walk>("walk", f),
                Stream::input::<Planes>("planes", f),
                Stream::output::<PrimaryBeat>("beat", f),
            ],
            Target::Mono => vec![
                Stream::input::<Walk>("walk", f),
                Stream::input::<Planes>("planes", f),
                Stream::output::<Request>("request", f),
                Stream { answers: Some("request"), ..Stream::input::<Response>("response", f) },
                Stream::output::<Pixel>("pixel", f),
            ],
            Target::Minimal => vec![
                Stream::input::<Setup>("setup", f),
                Stream::input::<PrimaryBeat>("beat", f),
                Stream::output::<Pixel>("left", f),
                Stream::output::<Pixel>("right", f),
            ],
            Target::Hybrid => vec![
                Stream::input::<Setup>("setup", f),
                Stream::input::<Edges>("edges", f),
                Stream::input::<PrimaryBeat>("beat", f),
                Stream::output::<Request>("request", f),
                Stream { answers: Some("request"), ..Stream::input::<Response>("response", f) },
                Stream::output::<Pixel>("left", f),
                Stream::output::<Pixel>("right", f),
            ],
            Target::Stereo => vec![
                Stream::input::<Walk>("walk", f),
                Stream::input::<Planes>("planes", f),
                Stream::input::<Setup>("setup", f),
                Stream::input::<Edges>("edges", f),
                Stream::output::<Request>("request", f),
                Stream { answers: Some("request"), ..Stream::input::<Response>("response", f) },
                Stream::output::<Pixel>("left", f),
                Stream::output::<Pixel>("right", f),
            ],
        }
    }
}

/// A stream of a unit inside a system, for probing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Probe {
    /// The unit.
    pub unit: Unit,
    /// Its Verilog module.
    pub module: &'static str,
    /// Path of the instance inside the system.
    pub path: String,
    /// The stream: one that it gives or, where more than other units' streams decides what comes in,
    /// takes.
    pub stream: Stream,
}

/// Instance of the hybrid in the stereo pipeline.
const HYBRID_IN_STEREO: &str = "u_hybrid";

/// The unit of an instance in any system.
pub fn unit_of(path: &str) -> Option<Unit> {
    let inner = path.strip_prefix(HYBRID_IN_STEREO).and_then(|rest| rest.strip_prefix('.'));
    Unit::ALL.into_iter().find(|unit| unit.instance() == inner.unwrap_or(path))
}

/// The probes of a system, in the order in which data passes through them.
pub fn probes(target: Target, config: &Config) -> Vec<Probe> {
    let f = &target.formats(config);
    let probe = |unit: Unit| {
        let output = |target: Target| {
            let streams = target.streams(f);
            let stream =
                streams.into_iter().find(|s| s.direction == crate::interface::Direction::Output);
            (target.module(), stream)
        };
        let edges = "sam_edge_interpolator";
        let (module, stream) = match unit {
            Unit::Primary => output(Target::Primary),
            Unit::XInterpolator => output(Target::XInterpolator),
            Unit::YInterpolator => output(Target::YInterpolator),
            Unit::Edge0 | Unit::Edge1 | Unit::Edge2 => output(Target::EdgeInterpolator),
            Unit::Depth => {
                (edges, Some(Stream::output::<edge_interpolator::DepthOutput>("value", f)))
            }
            Unit::Red | Unit::Green | Unit::Blue => {
                (edges, Some(Stream::output::<edge_interpolator::ColourOutput>("value", f)))
            }
            Unit::Display => output(Target::Display),
            Unit::Sampler => output(Target::Sampler),
            Unit::Filter => output(Target::Filter),
            Unit::Coverage => output(Target::Coverage),
            Unit::Blend => output(Target::Blend),
            Unit::Redirect => return None,
        };
        let path = match (target, unit) {
            (Target::Stereo, Unit::Primary) | (Target::Minimal | Target::Hybrid, _) => {
                String::new()
            }
            _ => format!("{HYBRID_IN_STEREO}."),
        };
        Some(Probe { unit, module, path: path + unit.instance(), stream: stream? })
    };
    let whole = matches!(target, Target::Hybrid | Target::Stereo);
    let present = |unit: &Unit| match unit {
        Unit::Primary => target == Target::Stereo,
        Unit::XInterpolator | Unit::YInterpolator | Unit::Display | Unit::Sampler => true,
        Unit::Depth => whole && config.interpolated_depth,
        Unit::Red | Unit::Green | Unit::Blue => whole && config.integrated,
        _ => whole,
    };
    let mut probes: Vec<Probe> = Unit::ALL.into_iter().filter(present).filter_map(probe).collect();
    // Slot queue and memory stand before blending.
    if let Some(blend) = probes.iter().position(|probe| probe.unit == Unit::Blend) {
        let stream = Stream::input::<blend::BlendPixel>("pixel", f);
        probes.insert(blend, Probe { stream, ..probes[blend].clone() });
    }
    probes
}
