//! Ways to find out what each eye sees: hidden surfaces, for one view, both, or the next frame.
