//! Progress of the work, for whoever waits for it.
//!
//! Long loops note here what they have done. Nothing is printed and no clock is read: a program that has something to
//! tell its user looks at [`now`] when it is time to.

use crate::text::Grouped;
use std::fmt;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// A piece of work, under way until this is dropped.
#[derive(Debug)]
pub struct Stage(Arc<Work>);

#[derive(Debug)]
struct Work {
    what: String,
    count: Option<Count>,
}

#[derive(Debug)]
struct Count {
    unit: &'static str,
    done: AtomicU64,
    of: Option<usize>,
}

/// All that is under way, the latest last.
static WORKS: Mutex<Vec<Arc<Work>>> = Mutex::new(Vec::new());

fn works() -> MutexGuard<'static, Vec<Arc<Work>>> {
    WORKS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Progress of the work that was begun last and goes on, in words.
pub fn now() -> Option<String> {
    works().last().map(|work| work.to_string())
}

impl Stage {
    /// Work that has no parts to count, such as `reading teapot.json`.
    pub fn new(what: impl Into<String>) -> Stage {
        Stage::begin(what.into(), None)
    }

    /// Work of so many parts, if that is known; [`Stage::done`] notes how many are done. `unit` is the word for several.
    pub fn counted(what: impl Into<String>, unit: &'static str, of: Option<usize>) -> Stage {
        Stage::begin(what.into(), Some(Count { unit, done: AtomicU64::new(0), of }))
    }

    /// Notes the number of parts that are done.
    #[inline]
    pub fn done(&self, parts: u64) {
        if let Some(count) = &self.0.count {
            count.done.store(parts, Ordering::Relaxed);
        }
    }

    fn begin(what: String, count: Option<Count>) -> Stage {
        let work = Arc::new(Work { what, count });
        works().push(Arc::clone(&work));
        Stage(work)
    }
}

impl Drop for Stage {
    fn drop(&mut self) {
        works().retain(|work| !Arc::ptr_eq(work, &self.0));
    }
}

/// The same items one by one; how many of them are done is noted. `what` is done with them, and `unit` is the word for
/// several of them: `over("drawing the left view", "polygons", …)`.
pub fn over<I: IntoIterator>(
    what: impl Into<String>,
    unit: &'static str,
    items: I,
) -> Over<I::IntoIter> {
    let items = items.into_iter();
    let (least, most) = items.size_hint();
    let of = most.filter(|&most| most == least);
    Over { items, begun: 0, stage: Stage::counted(what, unit, of) }
}

/// Items of which it is noted how many are done, see [`over`].
#[derive(Debug)]
pub struct Over<I> {
    items: I,
    begun: u64,
    stage: Stage,
}

impl<I: Iterator> Iterator for Over<I> {
    type Item = I::Item;

    #[inline]
    fn next(&mut self) -> Option<I::Item> {
        self.stage.done(self.begun);
        self.begun += 1;
        self.items.next()
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        self.items.size_hint()
    }
}

impl fmt::Display for Work {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(Count { unit, done, of }) = &self.count else {
            return write!(f, "still {}", self.what);
        };
        write!(f, "{}: {}", self.what, Grouped(done.load(Ordering::Relaxed)))?;
        if let Some(of) = of {
            write!(f, " of {}", Grouped(*of as u64))?;
        }
        write!(f, " {unit} so far")
    }
}

#[cfg(test)]
pub(crate) fn all() -> Vec<String> {
    works().iter().map(|work| work.to_string()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::Config;
    use crate::formats::{Eye, Formats, Rgba};
    use crate::scene::Geometry;
    use crate::setup::{Options, Polygon, Vertex};
    use crate::stereo::Job;
    use crate::texture::Lookup;
    use crate::work::Meter;

    /// Progress of these two works; other tests do other work meanwhile.
    fn told() -> Vec<String> {
        let own = |text: &String| text.contains("thinking") || text.contains("counting");
        all().into_iter().filter(own).collect()
    }

    #[test]
    fn it_is_known_how_far_the_work_is() {
        let thinking = Stage::new("thinking");
        assert_eq!(told(), ["still thinking"]);
        let mut numbers = over("counting", "numbers", 0..2_000_000);
        assert_eq!(numbers.nth(1234), Some(1234));
        assert_eq!(told(), ["still thinking", "counting: 1,234 of 2,000,000 numbers so far"]);
        drop(thinking);
        // Of these nobody knows how many there are before.
        let mut odd = over("counting on", "numbers", numbers.filter(|n| n % 2 == 1));
        assert_eq!([odd.next(), odd.next()], [Some(1235), Some(1237)]);
        assert_eq!(told()[1], "counting on: 1 numbers so far");
        assert_eq!(odd.count(), 2_000_000 / 2 - 619);
        assert_eq!(told(), [""; 0]);
    }

    /// Notes what is told while a view is drawn.
    struct Listener(Vec<String>);

    impl Meter for Listener {
        fn note(&mut self, _: impl FnOnce(&mut crate::work::Work)) {
            let own = |text: &String| text.starts_with("drawing the right view directly: ");
            self.0.extend(all().into_iter().filter(own));
            self.0.dedup();
        }
    }

    #[test]
    fn it_is_known_how_many_polygons_are_drawn() {
        // As many polygons as no other test draws.
        let (count, formats) = (1_003, Formats::new(&Config::DEFAULT));
        let side = 4 * formats.one_pixel() as i32;
        let vertices = [[0, 0], [side, 0], [0, side]];
        let vertices = vertices.map(|[x, y]| Vertex { x: [x; 2], y: [y; 2], ..Vertex::default() });
        let polygon = Polygon { vertices: vertices.to_vec(), ..Polygon::default() };
        let polygons = vec![polygon; count];
        let geometry = Geometry {
            width: 8,
            height: 8,
            background: Rgba::default(),
            polygons,
            textures: Vec::new(),
            scissor: Default::default(),
            counts: Default::default(),
        };
        let options = Options::new(&Config::DEFAULT);
        let job = Job::of(&geometry, Config::DEFAULT, options, Lookup::default());
        let mut listener = Listener(Vec::new());
        job.view(Eye::Right, &mut listener);
        listener.0.retain(|text| text.contains(" of 1,003 polygons so far"));
        let told = |n: u64| {
            format!("drawing the right view directly: {} of 1,003 polygons so far", Grouped(n))
        };
        assert_eq!(listener.0, (0..count as u64).map(told).collect::<Vec<_>>());
    }
}
