//! Blend: identities and distance from exact blending.

use wheatstone_golden::config::Config;
use wheatstone_golden::formats::{Area, Formats, Quantity, Tag};
use wheatstone_golden::pipeline::blend::{blend, factor, mix, BlendPixel};

#[test]
fn the_ends_are_identities_and_the_rest_is_rounded() {
    for s in 0..=255u8 {
        for b in 0..=255u8 {
            assert_eq!(mix(s, b, 0), b);
            assert_eq!(mix(s, b, 256), s);
            for t in 0..=256 {
                let exact =
                    (f64::from(s) * f64::from(t) + f64::from(b) * f64::from(256 - t)) / 256.0;
                assert!((f64::from(mix(s, b, t)) - exact).abs() <= 0.5);
            }
        }
    }
}

#[test]
fn the_factor_is_alpha_times_area() {
    for config in [Config::DEFAULT, Config::PAPER] {
        let f = Formats::new(&config);
        let full = f.full_area();
        for alpha in 0..=255u8 {
            for area in 0..=full {
                let t = factor(alpha, Area::new(area.into(), &f), &f);
                let exact = f64::from(alpha) / 255.0 * f64::from(area) / f64::from(full) * 256.0;
                assert!((f64::from(t) - exact).abs() <= 1.0, "{alpha} {area}: {t} for {exact}");
            }
            assert_eq!(factor(0, Area::new(full.into(), &f), &f), 0);
            assert_eq!(factor(alpha, Area::new(0, &f), &f), 0);
        }
        assert_eq!(factor(255, Area::new(full.into(), &f), &f), 256);
    }
}

#[test]
fn every_channel_of_a_pixel_is_mixed_by_its_alpha_and_area() {
    let mut random = fastrand::Rng::with_seed(1);
    for config in [Config::DEFAULT, Config::PAPER] {
        let f = Formats::new(&config);
        let full = u64::from(f.full_area());
        for _ in 0..10_000 {
            let [rgb, background] = [0; 2].map(|_| [0; 3].map(|_| random.u8(..)));
            let (alpha, area, tag) = (random.u8(..), random.u64(0..=full), random.i64(0..2));
            let (area, tag) = (Area::new(area as i64, &f), Tag::new(tag, &f));
            let blended = blend(&BlendPixel { rgb, alpha, area, background, tag }, &f);
            let t = f64::from(alpha) / 255.0 * area.raw() as f64 / full as f64;
            for ((s, b), c) in rgb.into_iter().zip(background).zip(blended.rgb) {
                let exact = f64::from(s) * t + f64::from(b) * (1.0 - t);
                // Half a step of the channel, and a 256th of the difference for the factor.
                assert!((f64::from(c) - exact).abs() <= 1.5, "{c} for {exact}");
            }
            assert_eq!(blended.tag, tag);
        }
    }
}
