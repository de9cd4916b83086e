//! Watching the streams between the units of a system.

use crate::interface::Beat;

/// A unit inside a system.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Unit {
    /// Primary pipeline, which gives the beats.
    Primary,
    /// X interpolator.
    XInterpolator,
    /// Y interpolator.
    YInterpolator,
    /// First edge.
    Edge0,
    /// Second edge.
    Edge1,
    /// Third edge.
    Edge2,
    /// Depth plane.
    Depth,
    /// Red plane.
    Red,
    /// Green plane.
    Green,
    /// Blue plane.
    Blue,
    /// Display placement.
    Display,
    /// Sampler.
    Sampler,
    /// Filter.
    Filter,
    /// Coverage.
    Coverage,
    /// Blend.
    Blend,
    /// Redirection.
    Redirect,
}

impl Unit {
    /// All units, in the order in which data passes through them.
    pub const ALL: [Unit; 16] = [
        Unit::Primary,
        Unit::XInterpolator,
        Unit::YInterpolator,
        Unit::Edge0,
        Unit::Edge1,
        Unit::Edge2,
        Unit::Depth,
        Unit::Red,
        Unit::Green,
        Unit::Blue,
        Unit::Display,
        Unit::Sampler,
        Unit::Filter,
        Unit::Coverage,
        Unit::Blend,
        Unit::Redirect,
    ];

    /// Name in reports: that of the instance without its prefix.
    pub fn name(self) -> &'static str {
        let instance = self.instance();
        instance.split('.').next_back().and_then(|i| i.strip_prefix("u_")).unwrap_or(instance)
    }

    /// Name of the Verilog instance inside its system, its generate block included.
    pub fn instance(self) -> &'static str {
        match self {
            Unit::Primary => "u_primary",
            Unit::XInterpolator => "u_x_interpolator",
            Unit::YInterpolator => "u_y_interpolator",
            Unit::Edge0 => "u_edge0",
            Unit::Edge1 => "u_edge1",
            Unit::Edge2 => "u_edge2",
            Unit::Depth => "u_planes.g_depth.u_depth",
            Unit::Red => "u_planes.g_colour.u_red",
            Unit::Green => "u_planes.g_colour.u_green",
            Unit::Blue => "u_planes.g_colour.u_blue",
            Unit::Display => "u_display",
            Unit::Sampler => "u_sampler",
            Unit::Filter => "u_filter",
            Unit::Coverage => "u_back.u_coverage",
            Unit::Blend => "u_back.u_blend",
            Unit::Redirect => "u_redirect",
        }
    }
}

/// Sees every beat that a unit takes and gives.
pub trait Observer {
    /// True if anything is done with the beats; if not, models skip what nobody needs.
    const ACTIVE: bool;
    /// A unit took a beat.
    fn input<B: Beat>(&mut self, unit: Unit, beat: &B);
    /// A unit gave a beat.
    fn output<B: Beat>(&mut self, unit: Unit, beat: &B);
}

/// Sees nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct Blind;

impl Observer for Blind {
    const ACTIVE: bool = false;
    #[inline]
    fn input<B: Beat>(&mut self, _: Unit, _: &B) {}
    #[inline]
    fn output<B: Beat>(&mut self, _: Unit, _: &B) {}
}
