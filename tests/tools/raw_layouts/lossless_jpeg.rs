//! A writer of lossless JPEG, each number as its difference from the one to the left (ITU T.81, annex H).

/// Width, height, components and bits of a picture, of whose numbers the components of a pixel stand side by
/// side.
pub fn encode([width, height, components, bits]: [usize; 4], numbers: &[u16]) -> Vec<u8> {
    let mut jpeg = vec![0xff, 0xd8, 0xff, 0xc3, 0, (8 + 3 * components) as u8, bits as u8];
    jpeg.extend([height, width].into_iter().flat_map(|size| (size as u16).to_be_bytes()));
    jpeg.push(components as u8);
    jpeg.extend((0..components as u8).flat_map(|id| [id, 0x11, 0]));
    // seventeen codes of five bits: how many bits a difference has
    jpeg.extend([0xff, 0xc4, 0, 2 + 17 + 17, 0, 0, 0, 0, 0, 17, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]);
    jpeg.extend(0..17);
    jpeg.extend([0xff, 0xda, 0, (6 + 2 * components) as u8, components as u8]);
    jpeg.extend((0..components as u8).flat_map(|id| [id, 0]));
    jpeg.extend([1, 0, 0]);
    let mut coded = Bits::default();
    let row = width * components;
    for (at, number) in numbers.iter().enumerate() {
        let before = match (at / row, at % row) {
            (0, column) if column < components => 1 << (bits - 1),
            (_, column) if column < components => numbers[at - row].into(),
            _ => i32::from(numbers[at - components]),
        };
        let difference = i32::from(*number) - before;
        let size = 32 - difference.unsigned_abs().leading_zeros();
        coded.put(size, 5);
        let rest = if difference < 0 { difference - 1 } else { difference };
        coded.put(rest.cast_unsigned() & ((1 << size) - 1), size);
    }
    coded.put(0x7f, 7);
    jpeg.extend(coded.bytes);
    jpeg.extend([0xff, 0xd9]);
    jpeg
}

#[derive(Default)]
struct Bits {
    bytes: Vec<u8>,
    waiting: u64,
    count: u32,
}

impl Bits {
    fn put(&mut self, value: u32, count: u32) {
        self.waiting = self.waiting << count | u64::from(value);
        self.count += count;
        while self.count >= 8 {
            self.count -= 8;
            let byte = (self.waiting >> self.count) as u8;
            self.bytes.push(byte);
            if byte == 0xff {
                self.bytes.push(0);
            }
        }
    }
}
