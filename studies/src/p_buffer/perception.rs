//! The three experiments on perception: their tests, from the means and deviations that are printed.

use crate::{Check, Row, Table};

/// Answers of one group of subjects: their mean and standard deviation.
type Answers = (f64, f64);

/// Welch's test that two means are the same.
struct Welch {
    t: f64,
    degrees: f64,
}

impl Welch {
    fn new(subjects: u32, [one, other]: [Answers; 2]) -> Welch {
        let n = f64::from(subjects);
        let [a, b] = [one, other].map(|(_, deviation)| deviation * deviation / n);
        let degrees = (a + b) * (a + b) / ((a * a + b * b) / (n - 1.0));
        Welch { t: (one.0 - other.0).abs() / (a + b).sqrt(), degrees }
    }

    /// Probability that chance makes them differ by so much in one direction.
    fn one_sided(&self) -> f64 {
        (1.0 - within(self.t, self.degrees)) / 2.0
    }

    /// The same in either direction.
    fn two_sided(&self) -> f64 {
        1.0 - within(self.t, self.degrees)
    }
}

/// Probability of a value between −t and t by Student's distribution. With t = √ν tan a its density is
/// proportional to cos^(ν − 1) a.
fn within(t: f64, degrees: f64) -> f64 {
    let density = |a: f64| a.cos().powf(degrees - 1.0);
    integral(density, (t / degrees.sqrt()).atan()) / integral(density, std::f64::consts::FRAC_PI_2)
}

/// The integral from 0 to `end` by Simpson's rule.
fn integral(f: impl Fn(f64) -> f64, end: f64) -> f64 {
    const STEPS: u32 = 2000;
    let step = end / f64::from(STEPS);
    let weight = |k: u32| match k {
        0 | STEPS => 1.0,
        k if k % 2 == 1 => 4.0,
        _ => 2.0,
    };
    (0..=STEPS).map(|k| weight(k) * f(f64::from(k) * step)).sum::<f64>() * step / 3.0
}

/// The tests of section III.
pub fn tests() -> Table {
    let cylinder = Welch::new(18, [(-0.222222, 2.211083), (1.833333, 1.424574)]);
    let solid = Welch::new(18, [(1.222222, 1.986885), (0.277778, 1.903729)]);
    let walk = Welch::new(16, [(0.3125, 2.08866), (0.875, 1.821172)]);
    let row = |what: &str, part: f64, printed: f64| {
        Row::new(what, 100.0 * part, 4, Check::Digits).printed(printed).unit("%")
    };
    let rows = vec![
        row("1, without the blue cylinder easier: confidence", 1.0 - cylinder.one_sided(), 99.8769),
        row("2, with and without the centre the same: significance", solid.two_sided(), 15.4537),
        row("3, walk, both methods the same: significance", walk.two_sided(), 42.3338),
    ];
    let title = "Experiments 1 to 3: Welch's t-test of the means and deviations that are printed";
    Table { title: title.into(), rows }
}

#[cfg(test)]
mod tests {
    #[test]
    fn student_s_distribution_has_its_known_values() {
        // One degree of freedom: 2/π atan t; two: t/√(2 + t²).
        for t in [0.3f64, 1.0, 4.0] {
            let one = std::f64::consts::FRAC_2_PI * t.atan();
            assert!((super::within(t, 1.0) - one).abs() < 1e-9);
            assert!((super::within(t, 2.0) - t / (2.0 + t * t).sqrt()).abs() < 1e-9);
        }
    }
}
