//! Ways to make the second view side by side: what each costs, and how wrong it is.
//!
//! All methods draw the same polygons: lit, projected, clipped and snapped for both eyes, which is
//! not timed. The first view is the left one, drawn directly, and what is timed and counted is
//! only what makes the right one ([`Timed`]). Errors are those against direct rendering: of the right
//! view where it alone is made, and of both views where both are ([`Judged`]).

mod method;
mod methods;
mod show;

pub use method::{Judged, Method, Pair, Timed, Unsuited};
pub use methods::METHODS;
pub use show::{json, table};

use crate::prepared::Prepared;
use crate::timing::{shortest, turns, Spell};
use std::fmt;
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use wheatstone_golden::files::WriteError;
use wheatstone_golden::formats::Eye;
use wheatstone_golden::frame::{Frame, NO_ID};
use wheatstone_golden::picture::{frame_picture, side_by_side, write_png, Rgb, RgbImage};
use wheatstone_golden::primary::Counts;
use wheatstone_golden::progress::Stage;
use wheatstone_golden::quality::Quality;
use wheatstone_golden::work::{Unmetered, Work};

/// A method with its result.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The method.
    pub method: Method,
    /// The measurements; or the reason why the method cannot draw the scene.
    pub result: Result<Measured, Unsuited>,
}

/// Measurements of a method.
#[derive(Clone, Debug)]
pub struct Measured {
    /// Work for the second view.
    pub work: Work,
    /// Statistics of the polygons by the way in which they were drawn, of a method that derives.
    pub counts: Option<Counts>,
    /// Time of the second view over that of direct rendering.
    pub time: Time,
    /// Time to make what must be made beforehand over that of direct rendering, if there is any.
    pub preparation: Option<f64>,
    /// The left and the right view against direct rendering.
    pub views: [Quality; 2],
    /// The views that the method makes against direct rendering.
    pub quality: Quality,
    /// The error picture.
    pub file: Option<PathBuf>,
}

/// Time of a second view in that of direct rendering, the shortest runs of each.
#[derive(Clone, Copy, Debug)]
pub struct Time {
    /// The ratio, at least 0.
    pub ratio: f64,
    /// Noise of the ratio: a ratio of no more is no measurement.
    pub noise: f64,
}

impl Time {
    /// Time of `part` beyond that of `rest`, by `whole`; at least 0.
    fn of(part: Spell, rest: Option<Spell>, whole: Spell) -> Time {
        let rest = rest.unwrap_or(Spell { shortest: Duration::ZERO, noise: Duration::ZERO });
        let by_whole = |time: Duration| time.as_secs_f64() / whole.shortest.as_secs_f64();
        Time {
            ratio: by_whole(part.shortest.saturating_sub(rest.shortest)),
            noise: by_whole(part.noise + rest.noise).max(0.01),
        }
    }

    /// True if it is more than noise.
    pub fn is_measured(&self) -> bool {
        self.ratio > self.noise
    }
}

impl fmt::Display for Time {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_measured() {
            return write!(f, "{:.2}", self.ratio);
        }
        // An upper bound is rounded up.
        write!(f, "<{:.2}", (self.noise * 100.0).ceil() / 100.0)
    }
}

/// Time that the rounds of one timing take together, about, if they are not very few.
const ROUNDS_TIME: Duration = Duration::from_secs(1);

/// Draws a scene by each method in turn; error pictures go into `out`, which exists. `tell` hears
/// which method begins.
pub fn compare(
    prepared: &Prepared,
    out: Option<&Path>,
    mut tell: impl FnMut(&Method),
) -> Result<Vec<Outcome>, WriteError> {
    let job = prepared.job();
    let start = Instant::now();
    let direct = job.direct();
    let rounds = ROUNDS_TIME.as_secs_f64() / start.elapsed().as_secs_f64().max(1e-6);
    let rounds = rounds.clamp(9.0, 31.0) as usize;
    let mut outcomes = Vec::new();
    for method in METHODS {
        tell(method);
        let _stage = Stage::new(format!("measuring {}", method.name));
        let result = match (method.draw)(prepared) {
            Err(unsuited) => Err(unsuited),
            Ok(mut pair) => {
                for eye in Eye::BOTH {
                    let outside = |x| !job.scissor.contains(eye, x);
                    pair.frames[eye as usize].clear_columns(outside, job.background);
                }
                let file = out.map(|folder| folder.join(format!("{}.png", method.name)));
                if let Some(file) = &file {
                    let errors = [0, 1].map(|n| error_picture(&pair.frames[n], &direct[n]));
                    write_png(file, &side_by_side(&[&errors[0], &errors[1]]))?;
                }
                let views = Eye::BOTH
                    .map(|e| Quality::of(&job, e, &pair.frames[e as usize], &direct[e as usize]));
                let quality = match method.judged {
                    Judged::Right => views[1],
                    Judged::Both => Quality::together(views),
                };
                let time = second_view_time(method, prepared, &direct[0], rounds);
                let preparation = preparation_time(method, prepared);
                let Pair { work, counts, .. } = pair;
                Ok(Measured { work, counts, time, preparation, views, quality, file })
            }
        };
        outcomes.push(Outcome { method: *method, result });
    }
    Ok(outcomes)
}

/// Time of a method's second view over that of direct rendering; all take turns.
fn second_view_time(method: &Method, prepared: &Prepared, left: &Frame, rounds: usize) -> Time {
    let mut direct = || drop(black_box(prepared.job().view(Eye::Right, &mut Unmetered)));
    match method.timed {
        Timed::Second(second) => {
            let mut second = || drop(black_box(second(prepared, left)));
            let [second, direct] = turns(rounds, [&mut second, &mut direct]);
            Time::of(second, None, direct)
        }
        Timed::Both { both, first } => {
            let mut both = || drop(black_box(both(prepared)));
            let mut first = || drop(black_box(first(prepared)));
            let [both, first, direct] = turns(rounds, [&mut both, &mut first, &mut direct]);
            Time::of(both, Some(first), direct)
        }
    }
}

/// Time of what a method must make beforehand over that of direct rendering of one view.
fn preparation_time(method: &Method, prepared: &Prepared) -> Option<f64> {
    let direct = || prepared.job().view(Eye::Right, &mut Unmetered);
    method.preparation.map(|make| {
        let made = make(prepared);
        made.as_secs_f64() / shortest(3, direct).as_secs_f64()
    })
}

/// Direct rendering in faint grey; over it red where another polygon is shown, magenta where none
/// is and there should be one, and yellow, the stronger the more it differs, where only the colour
/// is another.
pub fn error_picture(frame: &Frame, direct: &Frame) -> RgbImage {
    let mut errors = frame_picture(direct);
    for (n, pixel) in errors.pixels_mut().enumerate() {
        let [shown, wanted] = [frame.colour[n], direct.colour[n]];
        *pixel = Rgb(if frame.id[n] == NO_ID && direct.id[n] != NO_ID {
            [255, 0, 255]
        } else if frame.id[n] != direct.id[n] {
            [255, 40, 40]
        } else if shown != wanted {
            let difference = (0..3).map(|k| shown[k].abs_diff(wanted[k])).max().unwrap_or(0);
            let strength = 64 + difference.saturating_mul(8) / 4 * 3;
            [strength, strength, 0]
        } else {
            let light: u16 = wanted.iter().map(|&n| u16::from(n)).sum();
            [40 + (light / 9) as u8; 3]
        });
    }
    errors
}
