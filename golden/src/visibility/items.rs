//! Item buffers: what polygon each pixel shows, as the P-buffer's ids do (Heo, Jung and Wohn 1998, section
//! IV); here also what BSP tree and scan line (Adelson et al. 1991) resolve, which is shaded afterwards.

/// Item of a pixel that shows no polygon.
pub const NO_ITEM: u32 = u32::MAX;

/// Item buffer of a view: for each pixel the position of its polygon in
/// [`Surfaces::opaque`](super::Surfaces::opaque).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Items {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Positions, row by row from the top, [`NO_ITEM`] where there is none.
    pub item: Vec<u32>,
}

impl Items {
    /// A cleared buffer.
    pub fn new(width: u32, height: u32) -> Items {
        Items { width, height, item: vec![NO_ITEM; width as usize * height as usize] }
    }

    /// Clears the buffer.
    pub fn clear(&mut self) {
        self.item.fill(NO_ITEM);
    }

    /// A row.
    #[inline]
    pub fn row(&mut self, row: i32) -> &mut [u32] {
        let width = self.width as usize;
        &mut self.item[row as usize * width..(row as usize + 1) * width]
    }
}
