//! From strips or tiles to the pixels of a picture.

use std::io::{BufRead, Seek};

use half::f16;
use image::error::{DecodingError, LimitError, LimitErrorKind, UnsupportedError, UnsupportedErrorKind};
use image::{ColorType, ImageDecoder, ImageError, ImageFormat, ImageResult};
use tiff::decoder::{Decoder, Limits};
use tiff::{TiffError, TiffResult};

use super::described::Described;
use super::layout::{Kind, Layout};
use crate::image::reading::refused::MAX_BYTES;

/// The pixels of a page, to be decoded in place.
pub(super) struct Pixels<'a, R> {
    pub file: &'a mut R,
    pub layout: &'a Layout,
    /// Length of the file, bytes.
    pub length: u64,
}

impl<R: BufRead + Seek> ImageDecoder for Pixels<'_, R> {
    fn dimensions(&self) -> (u32, u32) {
        (self.layout.width, self.layout.height)
    }

    fn color_type(&self) -> ColorType {
        self.layout.color_type()
    }

    fn read_image(mut self, pixels: &mut [u8]) -> ImageResult<()> {
        self.decode(pixels).map_err(as_of_image)
    }

    fn read_image_boxed(self: Box<Self>, pixels: &mut [u8]) -> ImageResult<()> {
        (*self).read_image(pixels)
    }
}

impl<R: BufRead + Seek> Pixels<'_, R> {
    fn decode(&mut self, pixels: &mut [u8]) -> TiffResult<()> {
        let layout = self.layout;
        let wanted: Vec<usize> = layout.wanted().collect();
        if layout.is_as_wanted() {
            self.decoder(&layout.chunks)?.read_image_bytes(pixels)?;
        } else if layout.is_planar {
            let in_a_plane = layout.chunks.len() / layout.samples;
            for (place, plane) in wanted.iter().enumerate() {
                self.pick(&layout.chunks[plane * in_a_plane..][..in_a_plane], &[(0, place)], pixels)?;
            }
        } else {
            let picked: Vec<_> = wanted.iter().enumerate().map(|(place, sample)| (*sample, place)).collect();
            self.pick(&layout.chunks, &picked, pixels)?;
        }
        if layout.is_inverted {
            self.invert(pixels);
        }
        Ok(())
    }

    /// A decoder for some of the strips or tiles.
    fn decoder(&mut self, chunks: &[(u64, u64)]) -> TiffResult<Decoder<Described<&mut R>>> {
        let mut limits = Limits::unlimited();
        limits.intermediate_buffer_size = MAX_BYTES as usize;
        let described = Described::new(&mut *self.file, self.length, self.layout, chunks);
        Ok(Decoder::new(described)?.with_limits(limits))
    }

    /// Decodes some of the strips or tiles, and copies each sample of `picked` from its index among the
    /// interleaved ones to its index in a pixel.
    fn pick(
        &mut self,
        chunks: &[(u64, u64)],
        picked: &[(usize, usize)],
        pixels: &mut [u8],
    ) -> TiffResult<()> {
        let layout = self.layout;
        let mut decoder = self.decoder(chunks)?;
        let stored_pixel = layout.samples_together() * layout.kind.stored();
        let pixel = usize::from(layout.color_type().bytes_per_pixel());
        let (width, height) = decoder.chunk_dimensions();
        let across = layout.width.div_ceil(width);
        let mut decoded = Vec::new();
        for n in 0..chunks.len() as u32 {
            let (columns, rows) = decoder.chunk_data_dimensions(n);
            let (left, top) = ((n % across * width) as usize, (n / across * height) as usize);
            let row_bytes = columns as usize * stored_pixel;
            decoded.resize(row_bytes * rows as usize, 0);
            decoder.read_chunk_bytes(n, &mut decoded)?;
            let shown = (columns as usize).min(layout.width as usize - left);
            for (y, row) in (top..layout.height as usize).zip(decoded.chunks_exact(row_bytes)) {
                let to = &mut pixels[(y * layout.width as usize + left) * pixel..][..shown * pixel];
                for (from, to) in row.chunks_exact(stored_pixel).zip(to.chunks_exact_mut(pixel)) {
                    picked.iter().for_each(|place| put(layout.kind, from, to, *place));
                }
            }
        }
        Ok(())
    }

    /// Makes 0 black in a grey picture of integers.
    fn invert(&self, pixels: &mut [u8]) {
        let pixel = usize::from(self.layout.color_type().bytes_per_pixel());
        let grey = self.layout.kind.stored();
        pixels.chunks_exact_mut(pixel).flat_map(|pixel| &mut pixel[..grey]).for_each(|byte| *byte = !*byte);
    }
}

/// Copies a sample from its index in a stored pixel to its index in another.
#[inline]
fn put(kind: Kind, from: &[u8], to: &mut [u8], (sample, place): (usize, usize)) {
    let stored = &from[sample * kind.stored()..][..kind.stored()];
    match (kind, stored) {
        (Kind::F16, &[a, b]) => {
            to[4 * place..][..4].copy_from_slice(&f16::from_ne_bytes([a, b]).to_f32().to_ne_bytes());
        }
        (Kind::F64, &[a, b, c, d, e, f, g, h]) => {
            let number = f64::from_ne_bytes([a, b, c, d, e, f, g, h]) as f32;
            to[4 * place..][..4].copy_from_slice(&number.to_ne_bytes());
        }
        _ => to[kind.stored() * place..][..kind.stored()].copy_from_slice(stored),
    }
}

/// Converts an error of one decoder to that of the other.
fn as_of_image(error: TiffError) -> ImageError {
    match error {
        TiffError::IoError(error) => ImageError::IoError(error),
        TiffError::UnsupportedError(what) => {
            let kind = UnsupportedErrorKind::GenericFeature(what.to_string());
            ImageError::Unsupported(UnsupportedError::from_format_and_kind(ImageFormat::Tiff.into(), kind))
        }
        TiffError::LimitsExceeded => {
            ImageError::Limits(LimitError::from_kind(LimitErrorKind::InsufficientMemory))
        }
        error => ImageError::Decoding(DecodingError::new(ImageFormat::Tiff.into(), error)),
    }
}
