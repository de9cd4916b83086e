#![allow(missing_docs)]
use wheatstone_golden::{
    config::Config,
    formats::*,
    scene::{self, Cull},
    setup::Options,
    stereo::Job,
    texture::Lookup,
    visibility::*,
    work::*,
};
fn main() {
    let w: u32 = std::env::args().nth(1).and_then(|s| s.parse().ok()).unwrap_or(640);
    for name in ["village", "teapot", "exclusive", "room"] {
        let s = scene::open(name, Some([w, w * 3 / 4]), None).unwrap();
        let g = s
            .geometry(
                &Formats::new(&Config::DEFAULT),
                &scene::Options { cull: Cull::Back, ..Default::default() },
            )
            .unwrap();
        let job = Job {
            config: Config::DEFAULT,
            options: Options::new(&Config::DEFAULT),
            width: g.width,
            height: g.height,
            background: [0; 3],
            polygons: &g.polygons,
            textures: &g.textures,
            lookup: Lookup::Nearest,
        };
        let f = Surfaces::new(&job).unwrap();
        let [mut a, mut b] = [[f.items()], [f.items()]];
        let mut j = [f.items(), f.items()];
        let r = wheatstone_studies::timing::ratio(
            201,
            || {
                scan_line::draw_items::<f64, 1>(&f, [Eye::Left], &mut a, &mut Unmetered);
                scan_line::draw_items::<f64, 1>(&f, [Eye::Right], &mut b, &mut Unmetered)
            },
            || scan_line::draw_items::<f64, 2>(&f, Eye::BOTH, &mut j, &mut Unmetered),
        );
        println!(
            "{name} {} polys scan med {:.1}% min {:.1}% {:?}",
            f.opaque.len(),
            100.0 * (1.0 - 1.0 / r.median),
            100.0 * (1.0 - r.second.as_secs_f64() / r.first.as_secs_f64()),
            r
        );
    }
}
