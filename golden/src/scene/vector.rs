//! Vectors of three doubles, and circular functions that give the same bits on every machine.

/// A point or direction: x right, y up, z away from the viewer.
pub type Vec3 = [f64; 3];

/// Sum.
pub fn add(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// Difference.
pub fn sub(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Multiple.
pub fn scale(a: Vec3, k: f64) -> Vec3 {
    a.map(|n| n * k)
}

/// Inner product.
pub fn dot(a: Vec3, b: Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Outer product.
pub fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The vector of length 1 with the same direction; zero stays zero.
pub fn unit(a: Vec3) -> Vec3 {
    let largest = a.iter().fold(0.0, |m: f64, n| m.max(n.abs()));
    if largest == 0.0 {
        return a;
    }
    // Scaled first, so that nothing overflows or vanishes in the squares.
    let a = a.map(|n| n / largest);
    scale(a, 1.0 / dot(a, a).sqrt())
}

/// The point `t` of the way from `a` to `b`.
pub fn mix<const N: usize>(a: [f64; N], b: [f64; N], t: f64) -> [f64; N] {
    core::array::from_fn(|k| a[k] + (b[k] - a[k]) * t)
}

/// The least and the greatest of some numbers; infinity and minus infinity of none.
pub fn extent(numbers: impl Iterator<Item = f64>) -> [f64; 2] {
    let none = [f64::INFINITY, f64::NEG_INFINITY];
    numbers.fold(none, |[least, most], n| [least.min(n), most.max(n)])
}

/// Outward normal of a triangle whose front, seen counter-clockwise, is outside; its length is
/// twice the area. (Coordinates are left-handed: the order is the reverse of the usual one.)
pub fn outward(a: Vec3, b: Vec3, c: Vec3) -> Vec3 {
    cross(sub(c, a), sub(b, a))
}

/// Cosine and sine of a fraction of a full turn.
///
/// Exact at quarter turns; elsewhere within two units of the last place. Unlike the ones of the
/// system they do not depend on the machine, so that scenes made with them never change.
pub fn turn(fraction: f64) -> [f64; 2] {
    let eighths = (fraction - fraction.floor()) * 8.0;
    let octant = eighths.floor().min(7.0);
    let within = eighths - octant;
    let odd = octant as u32 % 2 == 1;
    let angle = if odd { 1.0 - within } else { within } * core::f64::consts::FRAC_PI_4;
    let square = angle * angle;
    let series = |first: f64| {
        // 1 - a²/(n(n+1)) (1 - a²/((n+2)(n+3)) (…)), n = 1 for the cosine and 2 for the sine.
        (0..10).rev().fold(1.0, |sum, k| {
            let n = first + 2.0 * f64::from(k);
            1.0 - sum * square / (n * (n + 1.0))
        })
    };
    let (cosine, sine) = (series(1.0), angle * series(2.0));
    let [x, y] = if odd { [sine, cosine] } else { [cosine, sine] };
    match octant as u32 / 2 {
        0 => [x, y],
        1 => [-y, x],
        2 => [-x, -y],
        _ => [y, -x],
    }
}

/// `a` turned by `degrees` about one of the axes (0 to 2).
///
/// Positive angles move the axis after it, in the order x, y, z, x, towards the one after that.
pub fn rotate(a: Vec3, axis: usize, degrees: f64) -> Vec3 {
    let [cosine, sine] = turn(degrees / 360.0);
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut turned = a;
    turned[u] = cosine * a[u] - sine * a[v];
    turned[v] = sine * a[u] + cosine * a[v];
    turned
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_match_the_system_and_are_exact_at_quarters() {
        for k in -1000..1000 {
            let t = f64::from(k) / 360.0;
            let [c, s] = turn(t);
            let a = t * core::f64::consts::TAU;
            assert!((c - a.cos()).abs() < 1e-14 && (s - a.sin()).abs() < 1e-14, "{t}");
        }
        assert_eq!(turn(0.0), [1.0, 0.0]);
        assert_eq!(turn(0.25), [0.0, 1.0]);
        assert_eq!(turn(-0.25), [0.0, -1.0]);
        assert_eq!(turn(0.5), [-1.0, 0.0]);
        assert!(turn(-1e-30).iter().all(|n| n.is_finite()));
    }

    #[test]
    fn a_counter_clockwise_triangle_faces_the_viewer() {
        let normal = outward([0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
        assert_eq!(normal, [0.0, 0.0, -1.0]);
    }

    #[test]
    fn unit_vectors_of_any_size() {
        for k in [1e-300, 1.0, 1e300] {
            assert_eq!(unit([0.0, k, 0.0]), [0.0, 1.0, 0.0]);
        }
        assert_eq!(unit([0.0; 3]), [0.0; 3]);
    }
}
