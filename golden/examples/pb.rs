//! c
use std::time::Instant;
use wheatstone_golden::visibility::{p_buffer::*, warping, z_buffer::ZBuffer};
use wheatstone_golden::{formats::*, scene::builtin::office, visibility::*, work::*};
fn best<T>(mut f: impl FnMut() -> T) -> f64 {
    let mut b = f64::MAX;
    for _ in 0..30 {
        let t = Instant::now();
        std::hint::black_box(f());
        b = b.min(t.elapsed().as_secs_f64() * 1e3);
    }
    b
}
fn main() {
    for n in [1, 15u32] {
        let s = office::scene(300, 300, n);
        let m = Model::new(&s);
        let [l, r] = Eye::BOTH.map(|e| View::of(&s, e));
        let mut z = ZBuffer::new(r, s.background);
        let mut vis = Visible::new(m.len());
        let full = best(|| {
            z.clear::<false>(r, s.background);
            z.draw_all::<false>(&m, &mut Unmetered);
        });
        let first = best(|| {
            z.clear::<true>(r, s.background);
            first_view(&m, &mut z, &mut vis, &mut Unmetered);
        });
        let src = z.frame.clone();
        let next = best(|| {
            z.clear::<false>(l, s.background);
            next_view::<false>(&m, &mut z, &vis, &mut Unmetered);
        });
        let mut w = Work::default();
        z.clear::<true>(l, s.background);
        next_view::<true>(&m, &mut z, &vis, &mut w);
        let mut t = ZBuffer::new(l, s.background);
        let mut w0 = Work::default();
        t.draw_all::<true>(&m, &mut w0);
        let wrong = warping::wrong_pixels(&z.frame, &t.frame);
        let d = warping::Disparity::new(&s.rig, Eye::Right);
        let warp = best(|| warping::other_eye(&src, Eye::Right, &d, s.background, &mut Unmetered));
        let f =
            warping::other_eye(&src, Eye::Right, &d, s.background, &mut Unmetered).faults(&t.frame);
        let p = |n: usize| f.percent(n);
        println!("{n}: vis {} full {full:.3} first {first:.3} ({:+.1}%) next {next:.3} warp {warp:.3} | tested {} / {} | P wrong {:.2}% warp wrong {:.2}% holes {:.2} over {:.2} see {:.2} edge {:.2}",vis.ids().len(),100.*(first/full-1.), w0.depth_tests, w.depth_tests,p(wrong),p(f.wrong()),p(f.holes),p(f.overlaps),p(f.see_through),p(f.edges));
        let c = View::between(&s);
        for (dx, turn) in [(-0.2, -3.0), (-0.2, 3.0), (-0.2, 0.0), (0.0, 3.0)] {
            let v = c.at(&Pose { moved: [dx, 0., 0.], turned: turn }, &s.rig);
            z.clear::<true>(c, s.background);
            first_view(&m, &mut z, &mut vis, &mut Unmetered);
            let src = z.frame.clone();
            z.clear::<true>(v, s.background);
            next_view::<true>(&m, &mut z, &vis, &mut Unmetered);
            t.clear::<true>(v, s.background);
            t.draw_all::<true>(&m, &mut Unmetered);
            let f = warping::moved(&src, &c, &v, s.background, &mut Unmetered).faults(&t.frame);
            println!("     {dx} {turn}: P {:.2}% warp {:.2}% holes {:.2} over {:.2} see {:.2} edge {:.2}",p(warping::wrong_pixels(&z.frame,&t.frame)),p(f.wrong()),p(f.holes),p(f.overlaps),p(f.see_through),p(f.edges));
        }
    }
}
