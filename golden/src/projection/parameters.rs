//! Parameters of the projections, their defaults, and what of them makes no sense.

use super::error::{check_length, RigError};
use super::map::DistanceMap;
use super::viewing::Viewing;
use serde::de::Error;
use serde::{Deserialize, Deserializer};

/// Parameters of the asymptotic projection (NASA 1992, appendix A). What is not given follows from
/// the rig.
///
/// Lengths on the viewer's side (all but `screen_intercept`) may be in another unit than the scene:
/// that of `screen_distance`, to which `pixels_per_unit` then refers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Asymptotic {
    /// SI, the distance in the scene that is seen at the screen; else the rig's viewing distance.
    pub screen_intercept: Option<f64>,
    /// SD, the distance of the screen; else the rig's viewing distance.
    pub screen_distance: Option<f64>,
    /// MAXD, where infinity is seen; may be infinite (`null` in files). Else 2 SD.
    #[serde(deserialize_with = "limit")]
    pub max_distance: Option<f64>,
    /// MIND, the nearest distance at which anything is seen: puts the near plane, NCP, where it
    /// belongs unless the rig has one.
    pub min_distance: Option<f64>,
    /// IPD, the distance between the eyes; else the rig's, in proportion to SD.
    pub eye_distance: Option<f64>,
}

/// Parameters of the piecewise projection (NASA 1992, appendix B).
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Piecewise {
    /// SD, the distance of the screen; else the rig's viewing distance.
    pub screen_distance: Option<f64>,
    /// IPD, the distance between the eyes; else the rig's, in proportion to SD.
    pub eye_distance: Option<f64>,
    /// The partitions, the nearest first; none stands for [`Piecewise::four`]. Between and beside
    /// them nothing is drawn.
    #[serde(deserialize_with = "bounded")]
    pub partitions: Vec<Partition>,
}

/// Most partitions of a projection.
pub const PARTITIONS_LIMIT: usize = 1_000;

/// An empty list would draw nothing; what is not there takes the default.
fn bounded<'de, D: Deserializer<'de>>(list: D) -> Result<Vec<Partition>, D::Error> {
    let partitions = Vec::deserialize(list)?;
    if !(1..=PARTITIONS_LIMIT).contains(&partitions.len()) {
        let expected = format!("1 to {PARTITIONS_LIMIT} partitions");
        return Err(D::Error::invalid_length(partitions.len(), &&*expected));
    }
    Ok(partitions)
}

/// A range of distances in the scene, and that in which it is perceived.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Partition {
    /// NCP, the nearest distance in the scene.
    pub near: f64,
    /// FCP, the farthest distance in the scene.
    pub far: f64,
    /// MIND, where `near` is perceived.
    pub min_distance: f64,
    /// MAXD, where `far` is perceived; `min_distance` makes the partition flat. May be infinite (`null`
    /// in files).
    #[serde(deserialize_with = "infinite")]
    pub max_distance: f64,
}

/// A distance, infinite if it is `null`.
fn infinite<'de, D: Deserializer<'de>>(value: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(value)?.unwrap_or(f64::INFINITY))
}

fn limit<'de, D: Deserializer<'de>>(value: D) -> Result<Option<f64>, D::Error> {
    infinite(value).map(Some)
}

/// As [`check_length`], but infinity is legal.
fn check_limit(field: &str, value: f64) -> Result<(), RigError> {
    if value == f64::INFINITY {
        return Ok(());
    }
    check_length(field, value)
}

impl Asymptotic {
    fn screen_distance(&self, viewing: &Viewing) -> f64 {
        self.screen_distance.unwrap_or(viewing.viewing_distance)
    }

    fn screen_intercept(&self, viewing: &Viewing) -> f64 {
        self.screen_intercept.unwrap_or(viewing.viewing_distance)
    }

    fn max_distance(&self, viewing: &Viewing) -> f64 {
        self.max_distance.unwrap_or(2.0 * self.screen_distance(viewing))
    }

    /// The map for a rig.
    pub fn map(&self, viewing: &Viewing) -> DistanceMap {
        let (si, sd) = (self.screen_intercept(viewing), self.screen_distance(viewing));
        DistanceMap::asymptotic(si, sd, self.max_distance(viewing))
    }

    /// Refuses what nothing can be projected with.
    pub fn check(&self, viewing: &Viewing) -> Result<(), RigError> {
        check_length("asymptotic.screen_intercept", self.screen_intercept(viewing))?;
        let sd = self.screen_distance(viewing);
        check_length("asymptotic.screen_distance", sd)?;
        let max = self.max_distance(viewing);
        check_limit("asymptotic.max_distance", max)?;
        if max <= sd {
            let expected = format!("more than the screen's distance, {sd}");
            return Err(RigError::new("asymptotic.max_distance", expected, max));
        }
        if let Some(eye_distance) = self.eye_distance {
            check_length("asymptotic.eye_distance", eye_distance)?;
        }
        if let Some(min) = self.min_distance {
            check_length("asymptotic.min_distance", min)?;
            if min >= max {
                let expected = format!("less than max_distance, {max}");
                return Err(RigError::new("asymptotic.min_distance", expected, min));
            }
        }
        Ok(())
    }
}

impl Partition {
    /// The partition's map.
    pub fn map(&self) -> DistanceMap {
        DistanceMap::piecewise(self.near, self.far, self.min_distance, self.max_distance)
    }

    fn check(&self, index: usize) -> Result<(), RigError> {
        let field = |name: &str| format!("piecewise.partitions[{index}].{name}");
        check_length(&field("near"), self.near)?;
        check_length(&field("far"), self.far)?;
        if self.near >= self.far {
            let expected = format!("more than near, which is {}", self.near);
            return Err(RigError::new(field("far"), expected, self.far));
        }
        check_length(&field("min_distance"), self.min_distance)?;
        check_limit(&field("max_distance"), self.max_distance)?;
        if self.min_distance > self.max_distance {
            let expected = format!("at least min_distance, which is {}", self.min_distance);
            return Err(RigError::new(field("max_distance"), expected, self.max_distance));
        }
        Ok(())
    }
}

impl Piecewise {
    /// Four partitions in the manner of NASA 1992, figure 7: stereo before the screen, flat at the
    /// screen, stereo behind it, flat at the far limit. `viewing_distance` (in the scene) is where
    /// the screen is put, `screen_distance` where it is, and `far` ends the scene.
    pub fn four(viewing_distance: f64, screen_distance: f64, far: f64) -> Vec<Partition> {
        let part = |[near, far]: [f64; 2], [min, max]: [f64; 2]| Partition {
            near: near * viewing_distance,
            far: far * viewing_distance,
            min_distance: min * screen_distance,
            max_distance: max * screen_distance,
        };
        vec![
            part([0.5, 1.0], [0.75, 1.0]),
            part([1.0, 1.25], [1.0, 1.0]),
            part([1.25, 2.0], [1.0, 1.5]),
            Partition { far, ..part([2.0, 0.0], [1.5, 1.5]) },
        ]
    }

    /// The partitions for a rig.
    pub fn partitions(&self, viewing: &Viewing) -> Vec<Partition> {
        if !self.partitions.is_empty() {
            return self.partitions.clone();
        }
        let d = viewing.viewing_distance;
        // A scene that ends before the last partition begins does without it.
        let far = viewing.far.unwrap_or(100.0 * d).max(2.0 * d);
        let mut partitions = Piecewise::four(d, self.screen_distance.unwrap_or(d), far);
        partitions.retain(|p| p.near < p.far);
        partitions
    }

    /// Refuses what nothing can be projected with.
    pub fn check(&self, viewing: &Viewing) -> Result<(), RigError> {
        for (field, value) in [
            ("piecewise.screen_distance", self.screen_distance),
            ("piecewise.eye_distance", self.eye_distance),
        ] {
            value.map_or(Ok(()), |value| check_length(field, value))?;
        }
        let partitions = self.partitions(viewing);
        for (index, partition) in partitions.iter().enumerate() {
            partition.check(index)?;
        }
        for (index, pair) in partitions.windows(2).enumerate() {
            if pair[1].near < pair[0].far {
                let expected = format!(
                    "at least {}, where partition {index} ends: partitions do not overlap, the nearest comes first",
                    pair[0].far
                );
                let field = format!("piecewise.partitions[{}].near", index + 1);
                return Err(RigError::new(field, expected, pair[1].near));
            }
        }
        Ok(())
    }
}
