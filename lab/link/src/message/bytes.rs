//! Values of ASN.1 as bytes, in UPER (`spec/6-link.md#limits`).

use rasn::{Decode, Encode, uper};

use super::error::{DecodeError, EncodeError, Pdu};

/// The most bytes of a message.
pub(super) const MOST: usize = 16_384;

/// The bytes of a value whose numbers are all in their ranges.
pub(super) fn encode(value: &impl Encode) -> Result<Vec<u8>, EncodeError> {
    let bytes = uper::encode(value).ok().filter(|bytes| bytes.len() <= MOST);
    bytes.ok_or_else(EncodeError::refused)
}

/// The value that all these bytes are the encoding of. The cap keeps what a decoder can be made to
/// allocate below a multiple of the bytes that somebody had to send.
pub(super) fn decode<T: Decode>(pdu: Pdu, bytes: &[u8]) -> Result<T, DecodeError> {
    if bytes.len() > MOST {
        return Err(DecodeError::TooLong { bytes: bytes.len() });
    }
    match uper::decode_with_remainder(bytes) {
        Ok((value, [])) => Ok(value),
        Ok((_, rest)) => Err(DecodeError::Trailing { pdu, bytes: rest.len() }),
        Err(error) => Err(DecodeError::Malformed { pdu, reason: error.to_string() }),
    }
}
