//! Greatest less least values within a window, without short peaks.
//!
//! A level counts as reached where the value stays at it or beyond for the hold time h. With the least value
//! `e(x)` and the greatest `d(x)` of the stretch from x to x + h, a window from s to s + T reaches up to the
//! greatest e and down to the least d of all x from s to s + T - h: the opening and the closing of the values
//! with a flat element of length h. Its range is the first less the second.
//!
//! A pulse shorter than h leaves no trace; a ramp of slope k has `k (T - 2h)`, since its highest and its
//! lowest h do not hold a level; a swing that never holds a level for h has none.
//!
//! Between two rows a value is a straight line. e and d are straight between places at which the stretch
//! begins or ends at a row, its ends have the same value, or an end passes the extreme row inside: all of
//! these are looked at, and so are windows that begin or end at them, so that the range is exact.

use std::collections::VecDeque;

use super::WindowValue;

/// A place with the least and the greatest value of the stretch from there.
#[derive(Clone, Copy)]
struct Held {
    place: f64,
    least: f64,
    greatest: f64,
}

/// Returns the largest range within windows of this length, of levels that are held for a time `hold` (all
/// of one unit; places grow); of all rows where there are fewer, whose length is then returned. `None` where
/// the rows or the window are shorter than the hold time.
#[must_use]
pub fn largest_range(places: &[f64], values: &[f64], length: f64, hold: f64) -> Option<WindowValue> {
    let (first, last) = (*places.first()?, *places.last()?);
    let length = length.min(last - first);
    let reach = length - hold;
    if reach < -1e-12 * length {
        return None;
    }
    let reach = reach.max(0.0);
    let mut held = held_levels(places, values, hold);
    let ahead = widest(&held, reach);
    // Windows that end at a place are those that begin at it, seen from behind.
    held.reverse();
    for own in &mut held {
        own.place = -own.place;
    }
    let behind = widest(&held, reach).map(|[value, place]| [value, -place - reach]);
    let best = [ahead, behind].into_iter().flatten();
    let [value, start] = best.reduce(|a, b| if b[0] > a[0] { b } else { a })?;
    Some(WindowValue {
        value: value.max(0.0),
        start,
        length,
    })
}

/// Returns the least and the greatest values of the stretches of a length at all places where these bend.
fn held_levels(places: &[f64], values: &[f64], hold: f64) -> Vec<Held> {
    let last = places[places.len() - 1] - hold;
    let at = |row: usize, place: f64| {
        // On the line from this row to the next one.
        match places.get(row + 1) {
            Some(next) => {
                let share = (place - places[row]) / (next - places[row]);
                values[row] + (values[row + 1] - values[row]) * share
            }
            None => values[row],
        }
    };
    let slack = 1e-9 * hold;
    let mut held = Vec::with_capacity(2 * places.len());
    // The last rows at or before the beginning and the end of the stretch.
    let (mut from, mut to) = (0, 0);
    let mut place = places[0];
    loop {
        while from + 1 < places.len() && places[from + 1] <= place + slack {
            from += 1;
        }
        while to + 1 < places.len() && places[to + 1] <= place + hold + slack {
            to += 1;
        }
        let (a, b) = (at(from, place), at(to, place + hold));
        let inside = &values[from + 1..=to.max(from)];
        let [low, high] = inside
            .iter()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], own| {
                [low.min(*own), high.max(*own)]
            });
        let here = |place: f64, a: f64, b: f64| Held {
            place,
            least: a.min(b).min(low),
            greatest: a.max(b).max(high),
        };
        held.push(here(place, a, b));
        if place >= last - slack {
            return held;
        }
        // The next place at which an end of the stretch comes to a row.
        let ahead = [(from, 0.0), (to, hold)].map(|(row, shift)| {
            let next = places.get(row + 1);
            next.map_or(last, |next| next - shift)
        });
        let next = ahead[0].min(ahead[1]).min(last);
        let (c, d) = (at(from, next), at(to, next + hold));
        // Until there both ends move on lines: where they meet, and where each passes what is inside.
        let crossing = |p: [f64; 2], q: [f64; 2]| {
            let (before, after) = (p[0] - q[0], p[1] - q[1]);
            (before * after < 0.0).then(|| before / (before - after))
        };
        let (begin, end) = ([a, c], [b, d]);
        let mut shares = [
            crossing(begin, end),
            crossing(begin, [low; 2]),
            crossing(end, [low; 2]),
            crossing(begin, [high; 2]),
            crossing(end, [high; 2]),
        ];
        shares.sort_by(|p, q| p.unwrap_or(2.0).total_cmp(&q.unwrap_or(2.0)));
        for share in shares.into_iter().flatten() {
            let on = |from: f64, to: f64| from + (to - from) * share;
            held.push(here(on(place, next), on(a, c), on(b, d)));
        }
        place = next;
    }
}

/// Returns the largest range of windows of a reach that begin at a place, and where that begins.
fn widest(held: &[Held], reach: f64) -> Option<[f64; 2]> {
    let mut greatest: VecDeque<usize> = VecDeque::new();
    let mut least: VecDeque<usize> = VecDeque::new();
    let mut best: Option<[f64; 2]> = None;
    let mut next = 0;
    let last = held.last()?.place;
    let slack = 1e-9 * reach;
    for (from, own) in held.iter().enumerate() {
        let end = own.place + reach;
        if end > last + slack && from > 0 {
            break;
        }
        while next < held.len() && held[next].place <= end + slack {
            let new = &held[next];
            while greatest.back().is_some_and(|k| held[*k].least <= new.least) {
                greatest.pop_back();
            }
            greatest.push_back(next);
            while least.back().is_some_and(|k| held[*k].greatest >= new.greatest) {
                least.pop_back();
            }
            least.push_back(next);
            next += 1;
        }
        for queue in [&mut greatest, &mut least] {
            while queue.front().is_some_and(|k| *k < from) {
                queue.pop_front();
            }
        }
        let (Some(up), Some(down)) = (greatest.front(), least.front()) else {
            continue;
        };
        let (mut top, mut bottom) = (held[*up].least, held[*down].greatest);
        // The end of the window, between two places.
        if let (Some(before), Some(after)) = (held.get(next.wrapping_sub(1)), held.get(next))
            && end > before.place
        {
            let share = (end - before.place) / (after.place - before.place);
            top = top.max(before.least + (after.least - before.least) * share);
            bottom = bottom.min(before.greatest + (after.greatest - before.greatest) * share);
        }
        if best.is_none_or(|best| top - bottom > best[0]) {
            best = Some([top - bottom, own.place]);
        }
    }
    best
}
