//! Back faces for both eyes at once.
//!
//! Adelson et al. 1991, "Stereoscopic Back-Face Removal", in its corrected form.
