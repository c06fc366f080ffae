//! Kinds of mutation.

mod letters;
mod lines;
mod numbers;
mod pieces;
mod random;

pub use random::Random;

use crate::limits::LONGEST_INPUT;

/// The material of mutations.
pub struct Material {
    /// The reader's own corpus.
    pub own: Vec<Vec<u8>>,
    /// The corpora of all other readers.
    pub foreign: Vec<Vec<u8>>,
    /// Pieces that mean something to the reader.
    pub dictionary: &'static [&'static [u8]],
}

/// A kind of mutation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mutation {
    /// All after a place is cut off.
    Truncate,
    /// A bit is the other one.
    FlipBit,
    /// Some bytes in a row are others: any, zeros, ones, or the least and greatest whole numbers.
    Replace,
    /// A range is taken out.
    Remove,
    /// A range stands several times, up to a hundred thousand times.
    Repeat,
    /// Two ranges change places.
    Swap,
    /// A piece of the reader's dictionary is put in, or replaces a range.
    Token,
    /// A number is an extreme one: zero, tiny, huge, infinite, none, or of thousands of digits.
    ExtremeNumber,
    /// Some digits of a number are others.
    Digits,
    /// A range stands in up to a hundred thousand brackets, or other marks that nest.
    Nest,
    /// A line is longer by up to a hundred thousand characters.
    LongLine,
    /// There are up to a hundred thousand lines more.
    ManyLines,
    /// Another line ending or encoding: CRLF, CR, a byte order mark, UTF-16, Latin-1, NUL.
    Encoding,
    /// A range is one of another entry of the same corpus.
    Splice,
    /// A range, or all of it, is of another reader's corpus: the wrong kind of file.
    SpliceForeign,
    /// Letters are in the other case, look like others, or carry marks.
    Letters,
    /// Lines are removed, repeated or in another order.
    Lines,
}

impl Mutation {
    /// All of them.
    pub const ALL: [Self; 17] = [
        Self::Truncate,
        Self::FlipBit,
        Self::Replace,
        Self::Remove,
        Self::Repeat,
        Self::Swap,
        Self::Token,
        Self::ExtremeNumber,
        Self::Digits,
        Self::Nest,
        Self::LongLine,
        Self::ManyLines,
        Self::Encoding,
        Self::Splice,
        Self::SpliceForeign,
        Self::Letters,
        Self::Lines,
    ];

    /// Changes the bytes. They may be as before, where there is nothing to change.
    pub fn apply(self, bytes: &mut Vec<u8>, random: &mut Random, material: &Material) {
        match self {
            Self::Truncate => bytes.truncate(random.below(bytes.len())),
            Self::FlipBit => pieces::flip_bit(bytes, random),
            Self::Replace => pieces::replace(bytes, random),
            Self::Remove => {
                let range = pieces::range(bytes, random);
                bytes.drain(range);
            }
            Self::Repeat => pieces::repeat(bytes, random),
            Self::Swap => pieces::swap(bytes, random),
            Self::Token => pieces::token(bytes, random, material.dictionary),
            Self::ExtremeNumber => numbers::extreme(bytes, random),
            Self::Digits => numbers::digits(bytes, random),
            Self::Nest => pieces::nest(bytes, random),
            Self::LongLine => lines::long(bytes, random),
            Self::ManyLines => lines::many(bytes, random),
            Self::Encoding => letters::encoding(bytes, random),
            Self::Splice => pieces::splice(bytes, random, &material.own),
            Self::SpliceForeign => match random.pick(&material.foreign) {
                Some(all) if random.once_in(4) => bytes.clone_from(all),
                _ => pieces::splice(bytes, random, &material.foreign),
            },
            Self::Letters => letters::letters(bytes, random),
            Self::Lines => lines::order(bytes, random),
        }
    }
}

/// So many copies that no more is made than an input may be long.
fn copies(wanted: usize, length: usize) -> usize {
    wanted.min(LONGEST_INPUT / length.max(1))
}

/// Puts bytes in at a place.
fn insert(bytes: &mut Vec<u8>, at: usize, piece: &[u8]) {
    bytes.splice(at..at, piece.iter().copied());
}

#[cfg(test)]
mod tests {
    use super::*;

    fn material() -> Material {
        Material {
            own: vec![b"angle = \"32 deg\"\nwidth = \"6 in\"\n".to_vec()],
            foreign: vec![b"\\BODY DATA\n1 2 3\n".to_vec()],
            dictionary: &[b"[wedge]", b"="],
        }
    }

    #[test]
    fn every_kind_changes_something_and_survives_nothing() {
        let material = material();
        for kind in Mutation::ALL {
            let mut changed = 0;
            for number in 0..200 {
                let mut random = Random::of("test", 1, number);
                let mut bytes = material.own[0].clone();
                kind.apply(&mut bytes, &mut random, &material);
                changed += usize::from(bytes != material.own[0]);
                for few in [&b""[..], b"7", b"\n", b"\xff\xfe"] {
                    kind.apply(&mut few.to_vec(), &mut random, &material);
                }
            }
            assert!(changed > 100, "{kind:?} changed {changed} of 200");
        }
    }

    #[test]
    fn nesting_goes_deep_and_repeating_far() {
        let material = material();
        let longest = |kind: Mutation| {
            let lengths = (0..2000).map(|number| {
                let mut bytes = material.own[0].clone();
                kind.apply(&mut bytes, &mut Random::of("test", 2, number), &material);
                bytes.len()
            });
            lengths.max().unwrap()
        };
        for kind in [
            Mutation::Nest,
            Mutation::Repeat,
            Mutation::LongLine,
            Mutation::ManyLines,
        ] {
            assert!(longest(kind) > 60_000, "{kind:?}: {}", longest(kind));
        }
    }
}
