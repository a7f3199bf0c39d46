//! Parallel work whose results are delivered in the order of the work.

use std::sync::mpsc::{Receiver, sync_channel};
use std::thread;

use crate::error::{Error, Result};

/// An item whose result is known, or must be computed.
pub enum Item<I, O> {
    /// The result.
    Known(O),
    /// What the result is computed from.
    ToDo(I),
    /// Nothing: a placeholder that reduces the number of items ahead while a large item before it is in
    /// memory.
    Place,
}

/// Runs `work` on items on all threads and passes the results to `done` in the order of the items, each as
/// soon as it and those before it are available.
///
/// Items are drawn on a separate thread, so that a slow source delays nothing else. At most `ahead` (1 or
/// more) are being processed or waiting for those before them, which bounds memory.
///
/// # Errors
/// [`Error::Numeric`] if no thread can be started; an error of `done`, after which only an item already being
/// awaited is drawn.
///
/// # Example
/// ```
/// use vfold::parallel::{Item, in_order};
/// let mut squares = Vec::new();
/// in_order((1..=4).map(Item::ToDo), 2, |n| n * n, |square| Ok(squares.push(square)))?;
/// assert_eq!(squares, [1, 4, 9, 16]);
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn in_order<I: Send, O: Send>(
    items: impl Iterator<Item = Item<I, O>> + Send,
    ahead: usize,
    work: impl Fn(I) -> O + Sync,
    mut done: impl FnMut(O) -> Result<()>,
) -> Result<()> {
    let work = &work;
    // The result being awaited is not in the queue.
    let (queue, results) = sync_channel::<Receiver<Option<O>>>(ahead - 1);
    thread::scope(|threads| {
        let draw = move || {
            rayon::in_place_scope(|jobs| {
                for item in items {
                    let (result, place) = sync_channel(1);
                    if queue.send(place).is_err() {
                        return;
                    }
                    // Nobody waits for a result after an error.
                    match item {
                        Item::Place => drop(result.send(None)),
                        Item::Known(known) => drop(result.send(Some(known))),
                        Item::ToDo(item) => jobs.spawn(move |_| drop(result.send(Some(work(item))))),
                    }
                }
            });
        };
        let drawing = thread::Builder::new().spawn_scoped(threads, draw);
        drawing.map_err(|error| {
            Error::Numeric(format!("cannot start a thread ({error}); allow more memory or processes"))
        })?;
        // A place stays empty if its work panicked; the scope passes the panic on.
        results.into_iter().map_while(|place| place.recv().ok()).flatten().try_for_each(&mut done)
    })
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};
    use std::time::Duration;

    use super::*;

    #[test]
    fn results_keep_their_order_and_few_are_ahead() {
        let (drawn, mut taken) = (AtomicUsize::new(0), 0);
        let items = (0..200_u64).inspect(|_| {
            drawn.fetch_add(1, Ordering::SeqCst);
        });
        let items = items.map(|n| if n % 3 == 0 { Item::Known(n) } else { Item::ToDo(n) });
        let work = |n: u64| {
            thread::sleep(Duration::from_micros(n * 7919 % 300));
            n
        };
        in_order(items, 5, work, |n| {
            assert_eq!(n, taken);
            assert!(drawn.load(Ordering::SeqCst) <= n as usize + 6, "{n}");
            taken += 1;
            Ok(())
        })
        .unwrap();
        assert_eq!(taken, 200);
    }

    #[test]
    fn an_error_ends_it() {
        let refused = |n| if n < 3 { Ok(()) } else { Err(Error::Numeric("enough".to_owned())) };
        assert!(in_order((0..).map(Item::ToDo), 4, |n| n, refused).is_err());
    }
}
