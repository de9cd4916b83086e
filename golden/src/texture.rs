//! Textures, and how a texel is looked up.

use crate::formats::Rgba;

/// A picture that polygons are covered with; it repeats in both directions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Texture {
    /// Columns, at least 1.
    pub width: u32,
    /// Rows, at least 1.
    pub height: u32,
    /// The texels, row by row from the top.
    pub texels: Vec<Rgba>,
}

/// Method of texture sampling.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Lookup {
    /// The texel that holds the point.
    #[default]
    Nearest,
    /// Weighted average of the four texels around the point, 8-bit weights.
    Bilinear,
}

impl Texture {
    /// True if any texel is translucent.
    pub fn is_translucent(&self) -> bool {
        self.texels.iter().any(|texel| texel.0[3] != 255)
    }

    /// True if no texel shows anything.
    pub fn is_invisible(&self) -> bool {
        self.texels.iter().all(|texel| texel.0[3] == 0)
    }

    fn texel(&self, column: i64, row: i64) -> Rgba {
        let column = column.rem_euclid(self.width.into());
        let row = row.rem_euclid(self.height.into());
        self.texels[(row * i64::from(self.width) + column) as usize]
    }

    /// Colour at a point given in texels with 8 fraction bits.
    pub fn lookup(&self, u: i64, v: i64, lookup: Lookup) -> Rgba {
        match lookup {
            Lookup::Nearest => self.texel(u >> 8, v >> 8),
            Lookup::Bilinear => self.bilinear(u - 128, v - 128),
        }
    }

    fn bilinear(&self, u: i64, v: i64) -> Rgba {
        let (column, row) = (u >> 8, v >> 8);
        let (right, down) = ((u & 255) as u32, (v & 255) as u32);
        let corners = [
            (self.texel(column, row), (256 - right) * (256 - down)),
            (self.texel(column + 1, row), right * (256 - down)),
            (self.texel(column, row + 1), (256 - right) * down),
            (self.texel(column + 1, row + 1), right * down),
        ];
        Rgba(core::array::from_fn(|channel| {
            let sum: u32 = corners.iter().map(|(c, w)| u32::from(c.0[channel]) * w).sum();
            ((sum + (1 << 15)) >> 16) as u8
        }))
    }
}
