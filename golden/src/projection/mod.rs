//! Projections: where the two eyes see a point on the screen.
