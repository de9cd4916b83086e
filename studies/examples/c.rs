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
    let a: Vec<String> = std::env::args().collect();
    let w: u32 = a[1].parse().unwrap();
    let s = if let Some(n) = a[2].strip_prefix("boxes") {
        wheatstone_studies::village::boxes::boxes(n.parse().unwrap(), w, w * 3 / 4).unwrap()
    } else {
        scene::open(&a[2], Some([w, w * 3 / 4]), None).unwrap()
    };
    let g = s
        .geometry(
            &Formats::new(&Config::DEFAULT),
            &scene::Options {
                cull: if a.len() > 4 { Cull::None } else { Cull::Back },
                ..Default::default()
            },
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
    let tree = bsp::Tree::new(&f);
    let [mut x, mut y] = [[f.items()], [f.items()]];
    let mut j = [f.items(), f.items()];
    let mut z = bsp::ZBuffer::default();
    for _ in 0..20000 {
        match &a[3][..] {
            "bsp1" => {
                bsp::draw(&f, &tree, [Eye::Left], &mut x, &mut z, &mut Unmetered);
                bsp::draw(&f, &tree, [Eye::Right], &mut y, &mut z, &mut Unmetered)
            }
            "bsp2" => bsp::draw(&f, &tree, Eye::BOTH, &mut j, &mut z, &mut Unmetered),
            "scan1" => {
                scan_line::draw_items::<f64, 1>(&f, [Eye::Left], &mut x, &mut Unmetered);
                scan_line::draw_items::<f64, 1>(&f, [Eye::Right], &mut y, &mut Unmetered)
            }
            _ => scan_line::draw_items::<f64, 2>(&f, Eye::BOTH, &mut j, &mut Unmetered),
        }
    }
}
