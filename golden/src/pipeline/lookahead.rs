//! Looking one beat ahead, to know which beat is the last in its secondary pixel.

/// A beat that may be followed by another in the same secondary pixel.
pub trait Lookahead: Sized {
    /// True if this beat opens a secondary pixel, so that the beat before it was an end.
    fn opens_pixel(&self) -> bool;
    /// True if no beat follows in this polygon.
    fn is_last(&self) -> bool;
    /// Tells the beat whether it is the last in its pixel.
    fn set_end(&mut self, end: bool);

    /// Takes the next beat of a stream; `waiting` holds the one whose end is not known yet. Gives
    /// the beats that are complete, oldest first.
    fn follow(mut self, waiting: &mut Option<Self>) -> [Option<Self>; 2] {
        let before = waiting.take().map(|mut before| {
            before.set_end(self.opens_pixel());
            before
        });
        if self.is_last() {
            self.set_end(true);
            return [before, Some(self)];
        }
        *waiting = Some(self);
        [before, None]
    }
}
