//! Messages to the thread that waits for a program.

/// An event for the thread that waits for a program.
pub(crate) enum Event {
    /// It ended.
    Ended,
    /// One of its streams did.
    Drained,
    /// It prints without end.
    Flood,
}
