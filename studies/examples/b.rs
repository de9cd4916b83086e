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
    let cull = if std::env::args().nth(2).is_some() { Cull::None } else { Cull::Back };
    for name in ["boxes12", "boxes40", "boxes80", "village"] {
        let s = if let Some(n) = name.strip_prefix("boxes") {
            wheatstone_studies::village::boxes(n.parse().unwrap(), w, w * 3 / 4)
        } else {
            scene::open(name, Some([w, w * 3 / 4]), None).unwrap()
        };
        let g = s
            .geometry(
                &Formats::new(&Config::DEFAULT),
                &scene::Options { cull, ..Default::default() },
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
        let t0 = std::time::Instant::now();
        let tree = bsp::Tree::new(&f);
        let el = t0.elapsed();
        let [mut a, mut b] = [[f.items()], [f.items()]];
        let mut j = [f.items(), f.items()];
        let mut z = [bsp::ZBuffer::default(), bsp::ZBuffer::default(), bsp::ZBuffer::default()];
        let [z0, z1, z2] = &mut z;
        let mut w = Work::default();
        bsp::draw(&f, &tree, Eye::BOTH, &mut j, z2, &mut w);
        let fr = f.frame(&j[0], Eye::Left);
        let pic = wheatstone_golden::picture::RgbImage::from_fn(fr.width, fr.height, |x, y| {
            wheatstone_golden::picture::Rgb(fr.colour[(y * fr.width + x) as usize])
        });
        wheatstone_golden::picture::write_png(
            std::path::Path::new(&format!("/tmp/{name}.png")),
            &pic,
        )
        .unwrap();
        let r = wheatstone_studies::timing::ratio(
            201,
            || {
                bsp::draw(&f, &tree, [Eye::Left], &mut a, z0, &mut Unmetered);
                bsp::draw(&f, &tree, [Eye::Right], &mut b, z1, &mut Unmetered)
            },
            || bsp::draw(&f, &tree, Eye::BOTH, &mut j, z2, &mut Unmetered),
        );
        println!("{name} {} polys {} pieces {} contested, z {} of {}, built in {el:?}; bsp med {:.1}% min {:.1}% {:?}",f.opaque.len(),tree.pieces(),tree.contested(),w.depth_tests,w.pixels_written,100.0*(1.0-1.0/r.median),100.0*(1.0-r.second.as_secs_f64()/r.first.as_secs_f64()),r);
    }
}
