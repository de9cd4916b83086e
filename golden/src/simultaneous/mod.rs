//! Work done for both views at once: projection and scan conversion with shared rows and edges.
//!
//! Adelson et al. 1991, "Differences and Similarities Between The Views", "Rendering Polygons".
