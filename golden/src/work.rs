//! Counting the work of an algorithm: arithmetic by numbers that count what is done with them,
//! everything else by a meter.
//!
//! An algorithm that is to be measured is generic over [`Real`] and [`Meter`]. With `f64` and
//! [`Unmetered`] it is compiled as if nothing were counted, which is the form that is timed; with
//! [`Counted`] and [`Work`] every operation is noted.

use serde::Serialize;
use std::cell::Cell;
use std::iter::Sum;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

/// Arithmetic that was done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Operations {
    /// Additions and subtractions.
    pub additions: u64,
    /// Multiplications.
    pub multiplications: u64,
    /// Divisions.
    pub divisions: u64,
    /// Comparisons.
    pub comparisons: u64,
}

impl Operations {
    /// Operations of some code, noted rather than counted by [`Counted`] numbers.
    pub const fn new(
        additions: u64,
        multiplications: u64,
        divisions: u64,
        comparisons: u64,
    ) -> Operations {
        Operations { additions, multiplications, divisions, comparisons }
    }

    /// So many comparisons and nothing else.
    pub const fn comparisons(comparisons: u64) -> Operations {
        Operations::new(0, 0, 0, comparisons)
    }

    /// Additions, multiplications and divisions.
    pub fn arithmetic(&self) -> u64 {
        self.additions + self.multiplications + self.divisions
    }

    /// All operations.
    pub fn all(&self) -> u64 {
        self.arithmetic() + self.comparisons
    }
}

impl Add for Operations {
    type Output = Operations;
    fn add(self, other: Operations) -> Operations {
        Operations {
            additions: self.additions + other.additions,
            multiplications: self.multiplications + other.multiplications,
            divisions: self.divisions + other.divisions,
            comparisons: self.comparisons + other.comparisons,
        }
    }
}

impl AddAssign for Operations {
    fn add_assign(&mut self, other: Operations) {
        *self = *self + other;
    }
}

impl Mul<u64> for Operations {
    type Output = Operations;
    /// The same done so many times.
    fn mul(self, times: u64) -> Operations {
        Operations {
            additions: self.additions * times,
            multiplications: self.multiplications * times,
            divisions: self.divisions * times,
            comparisons: self.comparisons * times,
        }
    }
}

impl Sub for Operations {
    type Output = Operations;
    fn sub(self, other: Operations) -> Operations {
        Operations {
            additions: self.additions - other.additions,
            multiplications: self.multiplications - other.multiplications,
            divisions: self.divisions - other.divisions,
            comparisons: self.comparisons - other.comparisons,
        }
    }
}

/// A real number, counted or not. Negation costs nothing.
pub trait Real:
    Copy
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
{
    /// The number of that value.
    fn of(value: f64) -> Self;
    /// Its value.
    fn value(self) -> f64;
}

impl Real for f64 {
    #[inline]
    fn of(value: f64) -> f64 {
        value
    }
    #[inline]
    fn value(self) -> f64 {
        self
    }
}

thread_local! {
    static DONE: Cell<Operations> = const { Cell::new(Operations {
        additions: 0, multiplications: 0, divisions: 0, comparisons: 0,
    }) };
}

/// Counts one operation of a kind.
fn one(kind: impl FnOnce(&mut Operations) -> &mut u64) {
    DONE.with(|done| {
        let mut operations = done.get();
        *kind(&mut operations) += 1;
        done.set(operations);
    });
}

/// Result of a piece of code, and its operations with [`Counted`] numbers on this thread.
pub fn counted<T>(code: impl FnOnce() -> T) -> (T, Operations) {
    let before = DONE.with(Cell::get);
    let result = code();
    (result, DONE.with(Cell::get) - before)
}

/// A number that counts its operations, see [`counted`].
#[derive(Clone, Copy, Debug, Default)]
pub struct Counted(f64);

impl Real for Counted {
    fn of(value: f64) -> Counted {
        Counted(value)
    }
    fn value(self) -> f64 {
        self.0
    }
}

impl Add for Counted {
    type Output = Counted;
    fn add(self, other: Counted) -> Counted {
        one(|done| &mut done.additions);
        Counted(self.0 + other.0)
    }
}

impl AddAssign for Counted {
    fn add_assign(&mut self, other: Counted) {
        *self = *self + other;
    }
}

impl Sub for Counted {
    type Output = Counted;
    fn sub(self, other: Counted) -> Counted {
        one(|done| &mut done.additions);
        Counted(self.0 - other.0)
    }
}

impl Mul for Counted {
    type Output = Counted;
    fn mul(self, other: Counted) -> Counted {
        one(|done| &mut done.multiplications);
        Counted(self.0 * other.0)
    }
}

impl Div for Counted {
    type Output = Counted;
    fn div(self, other: Counted) -> Counted {
        one(|done| &mut done.divisions);
        Counted(self.0 / other.0)
    }
}

impl Neg for Counted {
    type Output = Counted;
    fn neg(self) -> Counted {
        Counted(-self.0)
    }
}

impl PartialEq for Counted {
    fn eq(&self, other: &Counted) -> bool {
        one(|done| &mut done.comparisons);
        self.0 == other.0
    }
}

impl PartialOrd for Counted {
    fn partial_cmp(&self, other: &Counted) -> Option<std::cmp::Ordering> {
        one(|done| &mut done.comparisons);
        self.0.partial_cmp(&other.0)
    }
}

/// Receiver of the work that an algorithm notes, beside what [`Counted`] numbers count.
pub trait Meter {
    /// Notes work. Compiled to nothing in [`Unmetered`].
    fn note(&mut self, change: impl FnOnce(&mut Work));
}

/// Notes nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unmetered;

impl Meter for Unmetered {
    #[inline]
    fn note(&mut self, _: impl FnOnce(&mut Work)) {}
}

/// Work of an algorithm.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Work {
    /// Arithmetic of reals.
    pub operations: Operations,
    /// Arithmetic of coordinates, depths and colours in fixed point.
    pub fixed_point: Operations,
    /// Polygons or pieces of polygons scan-converted, counted for each view.
    pub polygons: u64,
    /// Values interpolated along edges and spans.
    pub interpolations: u64,
    /// Steps of an edge to its next scan line, insertions and sorting steps of edge lists.
    pub edge_updates: u64,
    /// Depth comparisons of pixels.
    pub depth_tests: u64,
    /// Pixels looked at.
    pub pixels_tested: u64,
    /// Pixels written.
    pub pixels_written: u64,
    /// Clips against one boundary.
    pub boundary_clips: u64,
    /// Beats of a pixel pipeline.
    pub beats: u64,
}

impl Meter for Work {
    #[inline]
    fn note(&mut self, change: impl FnOnce(&mut Work)) {
        change(self);
    }
}

impl Add for Work {
    type Output = Work;
    fn add(self, other: Work) -> Work {
        Work {
            operations: self.operations + other.operations,
            fixed_point: self.fixed_point + other.fixed_point,
            polygons: self.polygons + other.polygons,
            interpolations: self.interpolations + other.interpolations,
            edge_updates: self.edge_updates + other.edge_updates,
            depth_tests: self.depth_tests + other.depth_tests,
            pixels_tested: self.pixels_tested + other.pixels_tested,
            pixels_written: self.pixels_written + other.pixels_written,
            boundary_clips: self.boundary_clips + other.boundary_clips,
            beats: self.beats + other.beats,
        }
    }
}

impl Work {
    /// Pixels that were looked at: tested, moved or painted over.
    pub fn pixels(&self) -> u64 {
        self.pixels_tested.max(self.depth_tests).max(self.pixels_written)
    }

    /// Arithmetic of reals and in fixed point.
    pub fn arithmetic(&self) -> Operations {
        self.operations + self.fixed_point
    }

    /// Excess of this over other work of the same kind; 0 where it is less.
    pub fn beyond(&self, other: &Work) -> Work {
        let less = |own: u64, other: u64| own.saturating_sub(other);
        let operations = |own: &Operations, done: &Operations| Operations {
            additions: less(own.additions, done.additions),
            multiplications: less(own.multiplications, done.multiplications),
            divisions: less(own.divisions, done.divisions),
            comparisons: less(own.comparisons, done.comparisons),
        };
        Work {
            operations: operations(&self.operations, &other.operations),
            fixed_point: operations(&self.fixed_point, &other.fixed_point),
            polygons: less(self.polygons, other.polygons),
            interpolations: less(self.interpolations, other.interpolations),
            edge_updates: less(self.edge_updates, other.edge_updates),
            depth_tests: less(self.depth_tests, other.depth_tests),
            pixels_tested: less(self.pixels_tested, other.pixels_tested),
            pixels_written: less(self.pixels_written, other.pixels_written),
            boundary_clips: less(self.boundary_clips, other.boundary_clips),
            beats: less(self.beats, other.beats),
        }
    }
}

impl Sum for Work {
    fn sum<I: Iterator<Item = Work>>(works: I) -> Work {
        works.fold(Work::default(), Add::add)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn length<T: Real>(x: T, y: T) -> T {
        if x > y {
            x * x + y * y
        } else {
            (x - y) / -x
        }
    }

    #[test]
    fn operations_are_counted() {
        let (value, done) = counted(|| length(Counted::of(3.0), Counted::of(2.0)));
        assert_eq!(value.value(), length(3.0, 2.0));
        let sum = Operations { additions: 1, multiplications: 2, divisions: 0, comparisons: 1 };
        assert_eq!(done, sum);
        let (_, done) = counted(|| length(Counted::of(1.0), Counted::of(2.0)));
        assert_eq!((done.additions, done.divisions, done.all()), (1, 1, 3));
    }
}
