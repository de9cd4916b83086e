//! Projections: ways to map a scene to the two views of a screen.
//!
//! All of them move the scene sideways, project it from one centre and move the picture back, by
//! amounts that follow from a [`DistanceMap`] and the [`Viewer`]:
//!
//! x = SD·(x' ± POT)/d' ± VPT, y = SD·y'/d', + for the left eye, d' = z + d.
//!
//! The page `docs/projections.md` compares them and proves that disparity on a plane is affine in screen
//! coordinates in all of them, which is what the pipeline lives on. Distances in the scene are from
//! the plane of the eyes, z = −d. Sources, cited in full in `docs/README.md`: Adelson et al. 1991 (two
//! centres, shear, translation), Duvanenko and Robbins 1993 (translation, the display's units), NASA
//! 1992 (asymptotic, piecewise, clipping).

mod error;
mod field_of_view;
mod map;
mod matrix;
mod parameters;
mod viewing;

pub(crate) use error::{check_length, shown};
pub use error::{RigError, COORDINATE_LIMIT};
pub use field_of_view::{Clipping, FieldOfView, Screen};
pub use map::{Device, DistanceMap, Viewer};
pub use matrix::{multiply, transform, Matrix, ProjectionMatrix};
pub use parameters::{Asymptotic, Partition, Piecewise, PARTITIONS_LIMIT};
pub use viewing::Viewing;

use serde::de::Error;
use serde::{Deserialize, Deserializer};

/// Names of the projections.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Kind {
    /// [`Projection::TwoCentres`].
    #[default]
    TwoCentres,
    /// [`Projection::Shear`].
    Shear,
    /// [`Projection::Translate`].
    Translate,
    /// [`Projection::Asymptotic`].
    Asymptotic,
    /// [`Projection::Piecewise`].
    Piecewise,
    /// [`Projection::Symmetric`].
    Symmetric,
}

impl Kind {
    /// All of them, the usual one first.
    pub const ALL: [Kind; 6] = [
        Kind::TwoCentres,
        Kind::Shear,
        Kind::Translate,
        Kind::Asymptotic,
        Kind::Piecewise,
        Kind::Symmetric,
    ];

    /// Their names, in the same order.
    const NAMES: [&str; 6] =
        ["two-centres", "shear", "translate", "asymptotic", "piecewise", "symmetric"];

    /// Name on the command line and in rig files.
    pub fn name(self) -> &'static str {
        Kind::NAMES[self as usize]
    }

    /// Its line in `wheatstone list`.
    pub fn description(self) -> &'static str {
        match self {
            Kind::TwoCentres => "each eye a centre of projection: the screen is a window",
            Kind::Shear => "the scene sheared for each eye and projected from one centre",
            Kind::Translate => {
                "the scene moved for each eye, projected from one centre, moved back"
            }
            Kind::Asymptotic => "what is infinitely far is seen at a distance of choice",
            Kind::Piecewise => {
                "ranges of distances, each with its own range of perceived distances"
            }
            Kind::Symmetric => "two centres, each view cut symmetrically about its eye",
        }
    }

    /// The kind of that name.
    pub fn named(name: &str) -> Option<Kind> {
        Kind::ALL.into_iter().find(|kind| kind.name() == name)
    }
}

impl<'de> Deserialize<'de> for Kind {
    /// By its name.
    fn deserialize<D: Deserializer<'de>>(value: D) -> Result<Kind, D::Error> {
        let name = String::deserialize(value)?;
        Kind::named(&name).ok_or_else(|| D::Error::unknown_variant(&name, &Kind::NAMES))
    }
}

/// A projection with its parameters; a rig has the rest.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Projection {
    /// Each eye is a centre of projection (Adelson 1991): the screen is a window into the scene.
    #[default]
    TwoCentres,
    /// The data are sheared by z·e/(2d) and projected from the point between the eyes (Adelson 1991).
    Shear,
    /// The data are moved by e/2, projected from the point between the eyes and moved back (Adelson
    /// 1991; Duvanenko and Robbins 1993).
    Translate,
    /// Infinity is perceived at a distance of choice (NASA 1992, appendix A).
    Asymptotic(Asymptotic),
    /// Ranges of distances, each projected on its own (NASA 1992, appendix B).
    Piecewise(Piecewise),
    /// As two centres, but each view is cut off symmetrically about its eye (NASA 1992, figure 5),
    /// which leaves a strip as wide as the eyes are apart blank: at the right of the left view.
    Symmetric,
}

/// A range of distances in the scene that is projected in one way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Nearest scene distance.
    pub near: f64,
    /// Farthest scene distance.
    pub far: f64,
    /// Map from its distances to perceived distances.
    pub map: DistanceMap,
}

impl Range {
    /// Perceived distances of its near and its far end.
    pub fn perceived(&self) -> [f64; 2] {
        [self.near, self.far].map(|distance| self.map.perceived(distance))
    }

    /// True if another range, which is farther away, begins to be perceived nearer than this one ends: a point that
    /// recedes from the one to the other seems to approach.
    pub fn runs_back_to(&self, farther: &Range) -> bool {
        farther.perceived()[0] < self.perceived()[1] * (1.0 - 1e-9)
    }
}

impl Projection {
    /// Its kind.
    pub fn kind(&self) -> Kind {
        match self {
            Projection::TwoCentres => Kind::TwoCentres,
            Projection::Shear => Kind::Shear,
            Projection::Translate => Kind::Translate,
            Projection::Asymptotic(_) => Kind::Asymptotic,
            Projection::Piecewise(_) => Kind::Piecewise,
            Projection::Symmetric => Kind::Symmetric,
        }
    }

    /// The viewer and screen of a rig.
    pub fn viewer(&self, viewing: &Viewing) -> Viewer {
        let (eye_distance, screen_distance) = match self {
            Projection::Asymptotic(a) => (a.eye_distance, a.screen_distance),
            Projection::Piecewise(p) => (p.eye_distance, p.screen_distance),
            _ => (None, None),
        };
        let d = viewing.viewing_distance;
        let screen_distance = screen_distance.unwrap_or(d);
        let in_proportion = || viewing.eye_separation * (screen_distance / d);
        Viewer { eye_distance: eye_distance.unwrap_or_else(in_proportion), screen_distance }
    }

    /// The nearest distance that is drawn, where the projection says so.
    pub fn near(&self, viewing: &Viewing) -> Option<f64> {
        match self {
            Projection::Asymptotic(a) => a.min_distance.map(|min| a.map(viewing).scene(min)),
            Projection::Piecewise(p) => p.partitions(viewing).first().map(|p| p.near),
            _ => None,
        }
    }

    /// The farthest distance that is drawn, where the projection says so.
    pub fn far(&self, viewing: &Viewing) -> Option<f64> {
        match self {
            Projection::Piecewise(p) => p.partitions(viewing).last().map(|p| p.far),
            _ => None,
        }
    }

    /// The ranges that are projected, the nearest first, cut to the near and far planes of a rig. Its values and
    /// these parameters passed their checks.
    pub fn ranges(&self, viewing: &Viewing, [near, far]: [f64; 2]) -> Vec<Range> {
        match self {
            Projection::Piecewise(p) => {
                let partitions = p.partitions(viewing).into_iter().map(|p| Range {
                    near: p.near.max(near),
                    far: p.far.min(far),
                    map: p.map(),
                });
                partitions.filter(|range| range.near < range.far).collect()
            }
            Projection::Asymptotic(a) => vec![Range { near, far, map: a.map(viewing) }],
            _ => vec![Range { near, far, map: DistanceMap::IDENTITY }],
        }
    }

    /// Refuses parameters that make no sense with a rig whose own values do.
    pub fn check(&self, viewing: &Viewing) -> Result<(), RigError> {
        match self {
            Projection::TwoCentres | Projection::Shear | Projection::Translate => Ok(()),
            Projection::Symmetric => {
                if viewing.head_tilt != 0.0 {
                    let expected = "0 with projection symmetric, which cuts columns off";
                    return Err(RigError::new("head_tilt", expected, viewing.head_tilt));
                }
                Ok(())
            }
            Projection::Asymptotic(a) => a.check(viewing),
            Projection::Piecewise(p) => p.check(viewing),
        }
    }
}

impl From<Kind> for Projection {
    /// A projection whose parameters follow from the rig.
    fn from(kind: Kind) -> Projection {
        match kind {
            Kind::TwoCentres => Projection::TwoCentres,
            Kind::Shear => Projection::Shear,
            Kind::Translate => Projection::Translate,
            Kind::Asymptotic => Projection::Asymptotic(Asymptotic::default()),
            Kind::Piecewise => Projection::Piecewise(Piecewise::default()),
            Kind::Symmetric => Projection::Symmetric,
        }
    }
}
