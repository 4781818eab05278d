//! `asn1/mufasa-link.asn` as types (`spec/6-link.md#our-module`). Names and order are those of the module.
#![allow(clippy::no_effect_underscore_binding, reason = "in what rasn derives")]

use rasn::prelude::*;

/// The only version there is.
pub(super) const VERSION: u8 = 1;

#[derive(AsnType, Clone, Debug, Decode, Encode)]
#[rasn(automatic_tags)]
pub(super) struct Message {
    #[rasn(value("0..=255"))]
    pub(super) version: u8,
    #[rasn(value("0..=4294967295"))]
    pub(super) sender: u32,
    #[rasn(value("0..=4294967295"))]
    pub(super) receiver: u32,
    pub(super) generated: Time,
    pub(super) payload: Payload,
}

#[derive(AsnType, Clone, Debug, Decode, Encode)]
#[rasn(delegate, value("-9223372036854775808..=9223372036854775807"))]
pub(super) struct Time(pub(super) i64);

#[derive(AsnType, Clone, Debug, Decode, Encode)]
#[rasn(choice, automatic_tags)]
pub(super) enum Payload {
    Offer(Groups),
    Withdraw(()),
    Confirm(OfSession),
    Reject(OfSession),
    Tracks(Tracks),
    Trajectory(Trajectory),
    Request(OfSession),
    Release(OfSession),
    Alive(OfSession),
    State(State),
    Detections(Detections),
}

#[derive(AsnType, Clone, Debug, Decode, Encode)]
#[rasn(automatic_tags)]
pub(super) struct Groups {
    pub(super) mot: bool,
    pub(super) plan: bool,
}

#[derive(AsnType, Clone, Copy, Debug, Decode, Encode, PartialEq, Eq)]
#[rasn(enumerated)]
pub(super) enum Group {
    Mot = 0,
    Plan = 1,
}

#[derive(AsnType, Clone, Debug, Decode, Encode)]
#[rasn(delegate, value("0..=9223372036854775807"))]
pub(super) struct Session(pub(super) i64);

#[derive(AsnType, Clone, Debug, Decode, Encode)]
#[rasn(automatic_tags)]
pub(super) struct OfSession {
    pub(super) group: Group,
    pub(super) session: Session,
}

#[derive(AsnType, Clone, Debug, Decode, Encode)]
#[rasn(automatic_tags)]
pub(super) struct Tracks {
    pub(super) session: Session,
    pub(super) stamp: Measured,
    pub(super) cpm: Etsi,
}

#[derive(AsnType, Clone, Debug, Decode, Encode)]
#[rasn(automatic_tags)]
pub(super) struct State {
    pub(super) centre_offset: CentreOffset,
    pub(super) cam: Etsi,
}

#[derive(AsnType, Clone, Debug, Decode, Encode)]
#[rasn(automatic_tags)]
pub(super) struct Detections {
    pub(super) stamp: Measured,
    pub(super) centre_offset: CentreOffset,
    pub(super) cpm: Etsi,
}

#[derive(AsnType, Clone, Debug, Decode, Encode)]
#[rasn(delegate, size("0..=16384"))]
pub(super) struct Etsi(pub(super) OctetString);

#[derive(AsnType, Clone, Copy, Debug, Decode, Encode)]
#[rasn(delegate, value("-1500..=1500"))]
pub(super) struct Measured(pub(super) i16);

#[derive(AsnType, Clone, Copy, Debug, Decode, Encode)]
#[rasn(delegate, value("-10000..=10000"))]
pub(super) struct CentreOffset(pub(super) i16);

#[derive(AsnType, Clone, Debug, Decode, Encode)]
#[rasn(automatic_tags)]
pub(super) struct Trajectory {
    pub(super) session: Session,
    pub(super) stamp: Time,
    #[rasn(value("-800000000..=800000000"))]
    pub(super) latitude: i32,
    #[rasn(value("-1800000000..=1800000000"))]
    pub(super) longitude: i32,
    #[rasn(size("0..=1024"))]
    pub(super) points: SequenceOf<Point>,
}

#[derive(AsnType, Clone, Debug, Decode, Encode)]
#[rasn(automatic_tags)]
pub(super) struct Point {
    #[rasn(value("-134217728..=134217727"))]
    pub(super) time: i32,
    #[rasn(value("-134217728..=134217727"))]
    pub(super) x: i32,
    #[rasn(value("-134217728..=134217727"))]
    pub(super) y: i32,
    #[rasn(value("0..=35999"))]
    pub(super) direction: u16,
}
