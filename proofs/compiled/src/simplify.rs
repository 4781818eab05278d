//! Terms as simple as is cheap to see. The aim is that addresses, loops and states of enums stay
//! choices among numbers; the rest is the solver's.

use crate::term::{Node, Op, Term, Terms, mask, signed};

impl Terms {
    /// `op` of two terms of the same width.
    pub fn binary(&mut self, op: Op, one: Term, other: Term) -> Term {
        let swap = op.commutes()
            && (self.number(one).is_some(), one) > (self.number(other).is_some(), other);
        let (one, other) = if swap { (other, one) } else { (one, other) };
        let node = Node::Binary(op, one, other);
        let width = if op.compares() { 1 } else { self.width(one) };
        if let Some(known) = self.known.get(&(node, width)) {
            return *known;
        }
        let result = self.binary_anew(op, one, other).unwrap_or_else(|| self.put(node, width));
        self.known.insert((node, width), result);
        result
    }

    fn binary_anew(&mut self, op: Op, one: Term, other: Term) -> Option<Term> {
        let width = self.width(one);
        debug_assert_eq!(width, self.width(other), "{op:?}");
        if let (Some(one), Some(other)) = (self.number(one), self.number(other)) {
            let result_width = if op.compares() { 1 } else { width };
            return Some(self.constant(op.of(one, other, width), result_width));
        }
        if one == other {
            match op {
                Op::And | Op::Or => return Some(one),
                Op::Sub | Op::Xor => return Some(self.constant(0, width)),
                Op::Equal => return Some(self.truth(true)),
                Op::Below | Op::SignedBelow => return Some(self.truth(false)),
                Op::Add | Op::Mul | Op::ShiftLeft | Op::ShiftRight | Op::ShiftSigned => {}
            }
        }
        if width == 1 {
            return self.of_truths(op, one, other);
        }
        let with_number = self.number(other).and_then(|number| self.with_number(op, one, number));
        with_number.or_else(|| self.lifted(op, one, other))
    }

    /// Truth values are made of `And` and `Not` (and `Xor`), so that opposites are seen.
    fn of_truths(&mut self, op: Op, one: Term, other: Term) -> Option<Term> {
        match op {
            Op::Or => {
                let (one, other) = (self.not(one), self.not(other));
                let neither = self.and(one, other);
                return Some(self.not(neither));
            }
            Op::Equal => {
                let differ = self.binary(Op::Xor, one, other);
                return Some(self.not(differ));
            }
            Op::Xor => {
                return match (self.number(other), self.node(one), self.node(other)) {
                    (Some(0), ..) => Some(one),
                    (Some(_), ..) => Some(self.not(one)),
                    (_, Node::Not(inner), _) => {
                        let differ = self.binary(Op::Xor, inner, other);
                        Some(self.not(differ))
                    }
                    (.., Node::Not(inner)) => {
                        let differ = self.binary(Op::Xor, one, inner);
                        Some(self.not(differ))
                    }
                    _ => None,
                };
            }
            Op::And => {}
            _ => panic!("no operation on truth values: {op:?}"),
        }
        match self.number(other) {
            Some(0) => return Some(other),
            Some(_) => return Some(one),
            None => {}
        }
        if self.not(one) == other {
            return Some(self.truth(false));
        }
        for (whole, beside) in [(one, other), (other, one)] {
            let opposite = self.not(beside);
            match self.node(whole) {
                Node::Binary(Op::And, left, right) => {
                    if left == beside || right == beside {
                        return Some(whole);
                    }
                    if left == opposite || right == opposite {
                        return Some(self.truth(false));
                    }
                }
                // Not both of left and right, and one of them.
                Node::Not(both) => {
                    let Node::Binary(Op::And, left, right) = self.node(both) else { continue };
                    for (given, rest) in [(left, right), (right, left)] {
                        if given == beside {
                            let no = self.not(rest);
                            return Some(self.and(beside, no));
                        }
                        if given == opposite {
                            return Some(beside);
                        }
                    }
                }
                _ => {}
            }
        }
        None
    }

    fn with_number(&mut self, op: Op, one: Term, number: u64) -> Option<Term> {
        let width = self.width(one);
        let all = mask(width);
        match (op, number) {
            (
                Op::Add
                | Op::Or
                | Op::Xor
                | Op::Sub
                | Op::ShiftLeft
                | Op::ShiftRight
                | Op::ShiftSigned,
                0,
            )
            | (Op::Mul, 1) => return Some(one),
            (Op::Mul | Op::And, 0) => return Some(self.constant(0, width)),
            (Op::Below, 0) => return Some(self.truth(false)),
            (Op::And, _) if number == all => return Some(one),
            (Op::Or, _) if number == all => return Some(self.constant(all, width)),
            (Op::Sub, _) => {
                let negative = self.constant(number.wrapping_neg(), width);
                return Some(self.binary(Op::Add, one, negative));
            }
            _ => {}
        }
        match (op, self.node(one)) {
            (Op::Add | Op::And | Op::Or | Op::Xor, Node::Binary(inner, term, with))
                if inner == op =>
            {
                let with = self.number(with)?;
                let both = self.constant(op.of(with, number, width), width);
                Some(self.binary(op, term, both))
            }
            (Op::Equal | Op::Below, Node::Join(high, low)) if self.number(high) == Some(0) => {
                let low_width = self.width(low);
                if number >> low_width != 0 {
                    return Some(self.truth(op == Op::Below));
                }
                let number = self.constant(number, low_width);
                Some(self.binary(op, low, number))
            }
            _ => None,
        }
    }

    /// The operation on what is chosen, where that makes something simpler.
    fn lifted(&mut self, op: Op, one: Term, other: Term) -> Option<Term> {
        let simpler = |terms: &Self, term: Term| op.compares() || terms.chooses(term);
        match (self.node(one), self.node(other)) {
            (Node::Choice(if_one, yes, no), Node::Choice(if_other, other_yes, other_no))
                if if_one == if_other =>
            {
                let yes = self.binary(op, yes, other_yes);
                let no = self.binary(op, no, other_no);
                Some(self.choice(if_one, yes, no))
            }
            (Node::Choice(condition, yes, no), _)
                if self.choose_few(one, other)
                    || self.number(other).is_some() && simpler(self, one) =>
            {
                let yes = self.binary(op, yes, other);
                let no = self.binary(op, no, other);
                Some(self.choice(condition, yes, no))
            }
            (_, Node::Choice(condition, yes, no))
                if self.number(one).is_some() && simpler(self, other) =>
            {
                let yes = self.binary(op, one, yes);
                let no = self.binary(op, one, no);
                Some(self.choice(condition, yes, no))
            }
            _ => None,
        }
    }

    /// The other truth value.
    pub fn not(&mut self, term: Term) -> Term {
        match self.node(term) {
            Node::Constant(value) => self.truth(value == 0),
            Node::Not(inner) => inner,
            _ => self.put(Node::Not(term), 1),
        }
    }

    /// Both truth values.
    pub fn and(&mut self, one: Term, other: Term) -> Term {
        self.binary(Op::And, one, other)
    }

    /// One of the truth values, or both.
    pub fn or(&mut self, one: Term, other: Term) -> Term {
        self.binary(Op::Or, one, other)
    }

    /// All of these truth values.
    pub fn all(&mut self, truths: &[Term]) -> Term {
        let start = self.truth(true);
        truths.iter().fold(start, |all, truth| self.and(all, *truth))
    }

    /// `yes` if the condition is true, else `no`.
    pub fn choice(&mut self, condition: Term, yes: Term, no: Term) -> Term {
        let width = self.width(yes);
        debug_assert_eq!(width, self.width(no));
        match self.node(condition) {
            Node::Constant(1) => return yes,
            Node::Constant(_) => return no,
            Node::Not(inner) => return self.choice(inner, no, yes),
            _ => {}
        }
        if yes == no {
            return yes;
        }
        if width == 1 && (self.number(yes).is_some() || self.number(no).is_some()) {
            let on_yes = self.and(condition, yes);
            let otherwise = self.not(condition);
            let on_no = self.and(otherwise, no);
            return self.or(on_yes, on_no);
        }
        if let Node::Choice(inner, inner_yes, inner_no) = self.node(yes) {
            if inner == condition {
                return self.choice(condition, inner_yes, no);
            }
            if inner_no == no {
                let both = self.and(condition, inner);
                return self.choice(both, inner_yes, no);
            }
        }
        if let Node::Choice(inner, inner_yes, inner_no) = self.node(no) {
            if inner == condition {
                return self.choice(condition, yes, inner_no);
            }
            if inner_yes == yes {
                let either = self.or(condition, inner);
                return self.choice(either, yes, inner_no);
            }
        }
        self.put(Node::Choice(condition, yes, no), width)
    }

    /// 1 or 0 of this width.
    pub fn number_of_truth(&mut self, truth: Term, width: u8) -> Term {
        let (yes, no) = (self.constant(1, width), self.constant(0, width));
        self.choice(truth, yes, no)
    }

    /// Whether the term is not 0.
    pub fn is_set(&mut self, term: Term) -> Term {
        let zero = self.constant(0, self.width(term));
        let is_zero = self.binary(Op::Equal, term, zero);
        self.not(is_zero)
    }

    /// `width` bits from bit `low` on.
    pub fn part(&mut self, term: Term, low: u8, width: u8) -> Term {
        let from = self.width(term);
        debug_assert!(low + width <= from);
        if width == from {
            return term;
        }
        let known = (Node::Part(term, low), width);
        if let Some(known) = self.known.get(&known) {
            return *known;
        }
        let result = match self.node(term) {
            Node::Constant(value) => self.constant(value >> low, width),
            Node::Part(whole, offset) => self.part(whole, offset + low, width),
            Node::Join(high, rest) => {
                let split = self.width(rest);
                if low >= split {
                    self.part(high, low - split, width)
                } else if low + width <= split {
                    self.part(rest, low, width)
                } else {
                    let high = self.part(high, 0, low + width - split);
                    let rest = self.part(rest, low, split - low);
                    self.join(high, rest)
                }
            }
            Node::Choice(condition, yes, no) if self.chooses(yes) || self.chooses(no) => {
                let yes = self.part(yes, low, width);
                let no = self.part(no, low, width);
                self.choice(condition, yes, no)
            }
            Node::Binary(op @ (Op::And | Op::Or | Op::Xor), one, other) => {
                let one = self.part(one, low, width);
                let other = self.part(other, low, width);
                self.binary(op, one, other)
            }
            Node::Signed(inner) if low + width <= self.width(inner) => self.part(inner, low, width),
            _ => self.put(Node::Part(term, low), width),
        };
        self.known.insert(known, result);
        result
    }

    /// `high` above `low`.
    pub fn join(&mut self, high: Term, low: Term) -> Term {
        let width = self.width(high) + self.width(low);
        let known = (Node::Join(high, low), width);
        if let Some(known) = self.known.get(&known) {
            return *known;
        }
        let result = self.join_anew(high, low).unwrap_or_else(|| self.put(known.0, width));
        self.known.insert(known, result);
        result
    }

    fn join_anew(&mut self, high: Term, low: Term) -> Option<Term> {
        let (above, below) = (self.width(high), self.width(low));
        match (self.node(high), self.node(low)) {
            (Node::Constant(high), Node::Constant(low)) => {
                Some(self.constant(high << below | low, above + below))
            }
            (Node::Part(one, from), Node::Part(other, start))
                if one == other && from == start + below =>
            {
                Some(self.part(one, start, above + below))
            }
            (Node::Choice(if_high, yes, no), Node::Choice(if_low, low_yes, low_no))
                if if_high == if_low =>
            {
                let yes = self.join(yes, low_yes);
                let no = self.join(no, low_no);
                Some(self.choice(if_high, yes, no))
            }
            (Node::Choice(condition, yes, no), Node::Constant(_)) => {
                let (yes, no) = (self.join(yes, low), self.join(no, low));
                Some(self.choice(condition, yes, no))
            }
            (Node::Constant(_), Node::Choice(condition, yes, no)) => {
                let (yes, no) = (self.join(high, yes), self.join(high, no));
                Some(self.choice(condition, yes, no))
            }
            // What fits together comes together.
            (_, Node::Join(middle, rest)) => {
                let upper = self.join_anew(high, middle)?;
                Some(self.join(upper, rest))
            }
            _ => None,
        }
    }

    /// Widened with zeros.
    pub fn unsigned(&mut self, term: Term, width: u8) -> Term {
        let more = width - self.width(term);
        if more == 0 {
            return term;
        }
        let zeros = self.constant(0, more);
        self.join(zeros, term)
    }

    /// Widened with copies of the highest bit.
    pub fn signed(&mut self, term: Term, width: u8) -> Term {
        let from = self.width(term);
        match self.node(term) {
            _ if width == from => term,
            Node::Constant(value) => self.constant(signed(value, from).cast_unsigned(), width),
            Node::Choice(condition, yes, no) => {
                let (yes, no) = (self.signed(yes, width), self.signed(no, width));
                self.choice(condition, yes, no)
            }
            _ => self.put(Node::Signed(term), width),
        }
    }
}
