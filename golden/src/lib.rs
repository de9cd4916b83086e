//! Bit-exact model of the stereoscopic affine mapping (SAM) pipeline.
//!
//! The rules of the pipeline, the number formats and the streams are on the page
//! `ARCHITECTURE.md`; every model here has the name of the Verilog module it mirrors.
//!
//! Without the default feature `std` the crate is `no_std`: what remains is what firmware
//! runs on a board, the formats and the polygon setup.
#![cfg_attr(not(feature = "std"), no_std)]

extern crate alloc;

#[cfg(feature = "std")]
pub mod clipping;
pub mod config;
#[cfg(feature = "std")]
pub mod cost;
#[cfg(feature = "std")]
pub mod direct;
#[cfg(feature = "std")]
pub mod document;
#[cfg(feature = "std")]
pub mod faces;
#[cfg(feature = "std")]
pub mod files;
pub mod formats;
#[cfg(feature = "std")]
pub mod frame;
#[cfg(feature = "std")]
mod guard;
#[cfg(feature = "std")]
pub mod header;
pub mod interface;
#[cfg(feature = "std")]
pub mod picture;
pub mod pipeline;
#[cfg(feature = "std")]
pub mod primary;
#[cfg(feature = "std")]
pub mod progress;
#[cfg(feature = "std")]
pub mod projection;
#[cfg(feature = "std")]
pub mod quality;
#[cfg(feature = "std")]
pub mod random;
#[cfg(feature = "std")]
pub mod record;
#[cfg(feature = "std")]
pub mod scene;
pub mod setup;
#[cfg(feature = "std")]
pub mod simultaneous;
#[cfg(feature = "std")]
pub mod stereo;
#[cfg(feature = "std")]
pub mod targets;
#[cfg(feature = "std")]
pub mod text;
#[cfg(feature = "std")]
pub mod texture;
#[cfg(feature = "std")]
pub mod visibility;
#[cfg(feature = "std")]
pub mod work;
