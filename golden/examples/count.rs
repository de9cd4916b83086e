//! c
use wheatstone_golden::{
    config::Config,
    direct::Direct,
    formats::*,
    frame::*,
    scene::{self, builtin::office},
    stereo::pieces,
    texture::Lookup,
};
fn main() {
    let formats = Formats::new(&Config::DEFAULT);
    let want = [301, 474, 536, 569, 584, 604, 617, 623, 626, 632, 634, 636, 638, 638, 640];
    let d = Direct { formats, textures: &[], lookup: Lookup::Nearest };
    let shown = |s: &scene::Scene, w: u32| {
        let g = s.geometry(&formats, &scene::Options::default()).unwrap();
        let eye = Eye::Right;
        {
            let mut f = Frame::new(w, w, s.background);
            pieces(&g.polygons).for_each(|p| d.draw(&p, eye, &mut f));
            f
        }
    };
    let mut line = String::new();
    let mut l2 = String::new();
    let mut prev = 0i64;
    for n in 1..=15u32 {
        let s = office::scene(300, 300, n);
        let f = shown(&s, 300);
        let mut v: Vec<u32> = f.id.iter().copied().filter(|i| *i != NO_ID).collect();
        v.sort();
        v.dedup();
        let c = v.len() as i64;
        if n == 1 {
            print!(
                "ids {} structure {} desks",
                s.meshes[0].id_count(),
                v.iter().filter(|i| **i < 41).count()
            );
            let per = (s.meshes[0].id_count() as u32 - 41) / 6;
            for d in 0..6 {
                let b = 41 + d * per;
                let h = |r: std::ops::Range<u32>| {
                    v.iter().filter(|i| (b + r.start..b + r.end).contains(*i)).count()
                };
                print!(" {}({},{},{})", h(0..per), h(0..132), h(132..372), h(372..per));
            }
            println!();
        }
        let w = want[n as usize - 1];
        line += &format!("{c}({:+.1}%) ", 100. * (c as f64 / w as f64 - 1.));
        l2 += &format!("{} ", c - prev);
        prev = c;
    }
    println!("{line}\n{l2}\n301 173 62 33 15 20 13 6 3 6 2 2 2 0 2");
    if let Some(out) = std::env::args().nth(1) {
        for n in [1, 15] {
            let f = shown(&office::scene(600, 600, n), 600);
            let cols: Vec<Rgba> = f.colour.iter().map(|&[r, g, b]| Rgba([r, g, b, 255])).collect();
            wheatstone_golden::picture::write_png(
                std::path::Path::new(&format!("{out}{n}.png")),
                &wheatstone_golden::picture::colour_picture(600, 600, &cols),
            )
            .unwrap();
        }
    }
}
