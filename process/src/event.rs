//! Messages to the thread that waits for a program.

/// What is told to who waits for a program.
pub(crate) enum Event {
    /// It ended.
    Ended,
    /// One of its streams did.
    Drained,
    /// It prints without end.
    Flood,
}
