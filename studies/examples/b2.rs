//! x
use fastrand::Rng;
use wheatstone_golden::simultaneous::{flat, Corner, Edges};
use wheatstone_golden::work::*;
use wheatstone_studies::timing::ratio;
fn poly<const N: usize>(r: &mut Rng, sides: usize, reach: [f64;2]) -> Vec<Corner<2,N>> {
    let c = [128.0,128.0];
    let scale = 0.8+0.3*r.f64(); let shear = r.f64()*0.2-0.1; let turn = r.f64()*6.0;
    (0..sides).map(|k| { let a = turn+ (k as f64 + 0.6*r.f64())/sides as f64*6.2831853;
        let d=[a.cos()*reach[0], a.sin()*reach[1]];
        Corner { x: [c[0]+d[0], c[0]+5.0+scale*d[0]+shear*d[1]].map(|n| (n*256.0) as i32), y: ((c[1]+d[1])*256.0) as i32, values: [();N].map(|_| r.i32(0..256)) }}).collect()
}
fn views<const N: usize>(p: &[Vec<Corner<2,N>>]) -> [Vec<Vec<Corner<1,N>>>;2] {
    [0,1].map(|v| p.iter().map(|p| p.iter().map(|c| c.view(v)).collect()).collect())
}
fn main() {
    let mut r = Rng::with_seed(1);
    for w in [256usize, 272, 320] { for gap in [0usize, 1000] { for reach in [[40.0,40.0],[80.0,80.0]] { for sides in [4usize, 15] {
        let size=[w as u32, 256];
        let ps: Vec<_> = (0..200).map(|_| poly::<0>(&mut r, sides, reach)).collect();
        let s = views(&ps);
        let (mut e1, mut e2) = (Edges::new(size, 8), Edges::new(size, 8));
        let x = ratio(101, || { let mut n = 0; for v in 0..2 { for p in s[v].iter() { flat::fill(&mut e1, p, &mut Unmetered, |_,y,c| n += y*c.len()); } } n },
            || { let mut n = 0; for p in ps.iter() { flat::fill(&mut e2, p, &mut Unmetered, |v,y,c| n += (v+1)*y*c.len()); } n });
        print!("{w} {gap} {reach:?} {sides} nofill {:.3} {:?} {:?}  ", x.median, x.first/200, x.second/200);
        let mut all = vec![0u32; 2*w*256+gap];
        let (l, rr) = all.split_at_mut(w*256+gap);
        let mut bufs = [l, rr];
        let cell = std::cell::RefCell::new(&mut bufs);
        let x = ratio(101, || { let mut b = cell.borrow_mut(); for v in 0..2 { for (n,p) in s[v].iter().enumerate() { flat::fill(&mut e1, p, &mut Unmetered, |_,y,c| b[v][y*w..][..w][c].fill(n as u32)); } } },
            || { let mut b = cell.borrow_mut(); for (n,p) in ps.iter().enumerate() { flat::fill(&mut e2, p, &mut Unmetered, |v,y,c| b[v][y*w..][..w][c].fill(n as u32)); } });
        println!("flat {:.3} {:?} {:?}  ", x.median, x.first/200, x.second/200);
    }}}}
}
