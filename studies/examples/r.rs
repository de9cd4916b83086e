#![allow(missing_docs)]
use wheatstone_golden::{config::Config, formats::*, scene, visibility::renderer::*, work::*};
fn main() {
    let w: u32 = std::env::args().nth(1).and_then(|s| s.parse().ok()).unwrap_or(640);
    let s = scene::open("village", Some([w, w * 3 / 4]), None).unwrap();
    let m = Model::new(&s, &Formats::new(&Config::DEFAULT)).unwrap();
    let (mut a, mut b, mut c) = (m.views::<1>(), m.views::<1>(), m.views::<2>());
    let r = wheatstone_studies::timing::ratio(
        201,
        || {
            m.draw::<f64, 1>([Eye::Left], &mut a, &mut Unmetered);
            m.draw::<f64, 1>([Eye::Right], &mut b, &mut Unmetered)
        },
        || m.draw::<f64, 2>(Eye::BOTH, &mut c, &mut Unmetered),
    );
    println!(
        "render med {:.1}% min {:.1}% {:?}",
        100.0 * (1.0 - 1.0 / r.median),
        100.0 * (1.0 - r.second.as_secs_f64() / r.first.as_secs_f64()),
        r
    );
    let v = m.vertices::<f64, 2>(Eye::BOTH);
    let r = wheatstone_studies::timing::ratio(
        201,
        || {
            m.scan::<f64, 1>([Eye::Left], &v, &mut a, &mut Unmetered);
            m.scan::<f64, 1>([Eye::Right], &v, &mut b, &mut Unmetered)
        },
        || m.scan::<f64, 2>(Eye::BOTH, &v, &mut c, &mut Unmetered),
    );
    println!(
        "scan+gouraud med {:.1}% min {:.1}% {:?}",
        100.0 * (1.0 - 1.0 / r.median),
        100.0 * (1.0 - r.second.as_secs_f64() / r.first.as_secs_f64()),
        r
    );
}
