//! Clipping for both eyes at once: lines and polygons by Liang and Barsky's parametric method.
//!
//! Adelson et al. 1991, "Line and Polygon Clipping".
