//! The worst of many items, in bounded memory.

/// Keeps up to `most` items with the largest badness; among equals, the earliest.
///
/// # Example
/// ```
/// use vfold::score::Worst;
/// let mut worst = Worst::new(2);
/// [("a", 0.1), ("b", 0.7), ("c", 0.3)].into_iter().for_each(|(name, badness)| worst.add(badness, || name));
/// assert_eq!(worst.ranked().collect::<Vec<_>>(), [&"b", &"c"]);
/// assert_eq!((worst.in_order().collect::<Vec<_>>(), worst.seen()), (vec![&"b", &"c"], 3));
/// ```
#[derive(Clone, Debug)]
pub struct Worst<T> {
    most: usize,
    seen: usize,
    /// Worst first, each with its badness and the number of preceding items.
    kept: Vec<(f64, usize, T)>,
}

impl<T> Worst<T> {
    /// None yet.
    #[must_use]
    pub fn new(most: usize) -> Self {
        Self { most, seen: 0, kept: Vec::new() }
    }

    /// Counts an item, and keeps it if it is among the worst.
    pub fn add(&mut self, badness: f64, item: impl FnOnce() -> T) {
        let place = self.kept.partition_point(|(other, ..)| other.total_cmp(&badness).is_ge());
        if place < self.most {
            self.kept.insert(place, (badness, self.seen, item()));
            self.kept.truncate(self.most);
        }
        self.seen += 1;
    }

    /// Number of items seen.
    #[must_use]
    pub fn seen(&self) -> usize {
        self.seen
    }

    /// The kept items, worst first.
    pub fn ranked(&self) -> impl Iterator<Item = &T> {
        self.kept.iter().map(|(.., item)| item)
    }

    /// The kept items, in their original order.
    pub fn in_order(&self) -> impl Iterator<Item = &T> {
        let mut kept: Vec<_> = self.kept.iter().collect();
        kept.sort_by_key(|(_, before, _)| *before);
        kept.into_iter().map(|(.., item)| item)
    }
}
