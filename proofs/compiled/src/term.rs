//! Bit vectors of up to 64 bits as a graph in which equal terms are one term. What has one bit is a
//! truth value.

use std::collections::HashMap;

/// A term of a `Terms`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Term(u32);

impl Term {
    /// Its place in the graph; the parts of a term have smaller ones.
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

/// What a term is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// A number; bits beyond the width are 0.
    Constant(u64),
    /// The arbitrary value of this number.
    Variable(u32),
    /// An operation on two terms of the same width.
    Binary(Op, Term, Term),
    /// The other truth value.
    Not(Term),
    /// The second if the first is true, else the third.
    Choice(Term, Term, Term),
    /// Bits of a term from this one on.
    Part(Term, u8),
    /// The first above the second.
    Join(Term, Term),
    /// Widened with copies of the highest bit.
    Signed(Term),
}

/// Operations; the last three make truth values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Op {
    /// Modulo two to the width.
    Add,
    /// Modulo two to the width.
    Sub,
    /// Modulo two to the width.
    Mul,
    /// Bit by bit.
    And,
    /// Bit by bit; of truth values it is made of `And` and `Not`.
    Or,
    /// Bit by bit.
    Xor,
    /// The second is below the width.
    ShiftLeft,
    /// The second is below the width.
    ShiftRight,
    /// The second is below the width; copies the highest bit.
    ShiftSigned,
    /// Equal.
    Equal,
    /// Less, without a sign.
    Below,
    /// Less, with a sign.
    SignedBelow,
}

impl Op {
    /// All of them.
    pub const ALL: [Self; 12] = [
        Self::Add,
        Self::Sub,
        Self::Mul,
        Self::And,
        Self::Or,
        Self::Xor,
        Self::ShiftLeft,
        Self::ShiftRight,
        Self::ShiftSigned,
        Self::Equal,
        Self::Below,
        Self::SignedBelow,
    ];

    /// Whether the result is a truth value.
    pub const fn compares(self) -> bool {
        matches!(self, Self::Equal | Self::Below | Self::SignedBelow)
    }

    /// Whether the two terms may change places.
    pub const fn commutes(self) -> bool {
        matches!(self, Self::Add | Self::Mul | Self::And | Self::Or | Self::Xor | Self::Equal)
    }

    /// The result for two numbers of this width.
    pub const fn of(self, one: u64, other: u64, width: u8) -> u64 {
        let result = match self {
            Self::Add => one.wrapping_add(other),
            Self::Sub => one.wrapping_sub(other),
            Self::Mul => one.wrapping_mul(other),
            Self::And => one & other,
            Self::Or => one | other,
            Self::Xor => one ^ other,
            Self::ShiftLeft => one << other,
            Self::ShiftRight => one >> other,
            Self::ShiftSigned => (signed(one, width) >> other).cast_unsigned(),
            Self::Equal => return (one == other) as u64,
            Self::Below => return (one < other) as u64,
            Self::SignedBelow => return (signed(one, width) < signed(other, width)) as u64,
        };
        result & mask(width)
    }
}

/// All bits of this width.
pub const fn mask(width: u8) -> u64 {
    u64::MAX >> (64 - width)
}

/// The number with its sign.
pub const fn signed(value: u64, width: u8) -> i64 {
    let shift = 64 - width;
    (value << shift).cast_signed() >> shift
}

/// The graph.
#[derive(Debug, Default)]
pub struct Terms {
    nodes: Vec<(Node, u8)>,
    found: HashMap<(Node, u8), Term>,
    /// Among how many numbers a term chooses, each as often as it is written; 0: not among numbers.
    numbers: Vec<u32>,
    /// Results of `simplify`, so that no term is walked twice.
    pub(crate) known: HashMap<(Node, u8), Term>,
}

impl Terms {
    /// What the term is made of.
    pub fn node(&self, term: Term) -> Node {
        self.nodes[term.index()].0
    }

    /// Bits of the term.
    pub fn width(&self, term: Term) -> u8 {
        self.nodes[term.index()].1
    }

    /// How many terms there are.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The number that the term is, if it is one.
    pub fn number(&self, term: Term) -> Option<u64> {
        match self.node(term) {
            Node::Constant(value) => Some(value),
            _ => None,
        }
    }

    /// Whether the term is a number or a choice among numbers.
    pub fn chooses(&self, term: Term) -> bool {
        self.numbers[term.index()] > 0
    }

    /// Whether both choose among numbers, so few that an operation on each pair of them is one more
    /// choice and no explosion.
    pub(crate) fn choose_few(&self, one: Term, other: Term) -> bool {
        const FEW: u32 = 256;
        let pairs = self.numbers[one.index()].saturating_mul(self.numbers[other.index()]);
        (1..=FEW).contains(&pairs)
    }

    /// The term of this node as it stands.
    pub(crate) fn put(&mut self, node: Node, width: u8) -> Term {
        if let Some(term) = self.found.get(&(node, width)) {
            return *term;
        }
        let term = Term(u32::try_from(self.nodes.len()).expect("fewer than 2^32 terms"));
        let numbers = match node {
            Node::Constant(_) => 1,
            Node::Choice(_, yes, no) if self.chooses(yes) && self.chooses(no) => {
                self.numbers[yes.index()].saturating_add(self.numbers[no.index()])
            }
            _ => 0,
        };
        self.nodes.push((node, width));
        self.numbers.push(numbers);
        self.found.insert((node, width), term);
        term
    }

    /// A number.
    pub fn constant(&mut self, value: u64, width: u8) -> Term {
        self.put(Node::Constant(value & mask(width)), width)
    }

    /// A truth value.
    pub fn truth(&mut self, value: bool) -> Term {
        self.constant(value.into(), 1)
    }

    /// An arbitrary value.
    pub fn variable(&mut self, number: u32, width: u8) -> Term {
        self.put(Node::Variable(number), width)
    }
}

impl Terms {
    /// The number that the term is for these values of the variables; others are 0.
    pub fn value(&self, term: Term, variables: &HashMap<u32, u64>) -> u64 {
        let mut values: Vec<u64> = Vec::with_capacity(term.index() + 1);
        for (node, width) in &self.nodes[..=term.index()] {
            let of = |term: Term| values[term.index()];
            values.push(match *node {
                Node::Constant(value) => value,
                Node::Variable(number) => variables.get(&number).copied().unwrap_or(0),
                Node::Binary(op, one, other) => op.of(of(one), of(other), self.width(one)),
                Node::Not(one) => 1 - of(one),
                Node::Choice(condition, yes, no) => of(if of(condition) == 1 { yes } else { no }),
                Node::Part(one, low) => of(one) >> low & mask(*width),
                Node::Join(high, low) => of(high) << self.width(low) | of(low),
                Node::Signed(one) => {
                    signed(of(one), self.width(one)).cast_unsigned() & mask(*width)
                }
            });
        }
        values[term.index()]
    }
}
