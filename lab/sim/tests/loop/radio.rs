//! The link: each message once, in the order of arrival, not before its time, and some never.

use mufasa_sim::radio::{Radio, Settings, To};

const MESSAGES: u64 = 20_000;
/// Time between two messages, ns.
const APART: i64 = 1_000_000;

/// Sends numbered messages and takes them out every 10 ms: their numbers with arrival and place.
fn through(settings: Settings, seed: u64) -> Vec<(u64, i64, To)> {
    let mut radio = Radio::new(settings, seed);
    let mut received = Vec::new();
    let mut now_ns = 0;
    for number in 0..MESSAGES + 1000 {
        if number < MESSAGES {
            let to = if number % 2 == 0 { To::Vehicle } else { To::Station };
            radio.send(now_ns, to, number.to_le_bytes().to_vec());
        }
        if number % 10 == 0 {
            while let Some((arrival_ns, to, bytes)) = radio.receive(now_ns) {
                assert!(arrival_ns <= now_ns, "before it arrives");
                let bytes = bytes.try_into().expect("eight bytes");
                received.push((u64::from_le_bytes(bytes), arrival_ns, to));
            }
        }
        now_ns += APART;
    }
    received
}

fn sent_ns(number: u64) -> i64 {
    i64::try_from(number).expect("small") * APART
}

#[test]
fn each_message_arrives_once_in_order_and_not_too_early() {
    let settings = Settings { loss: 0.0, ..Settings::default() };
    let received = through(settings, 1);
    assert!(received.windows(2).all(|pair| pair[0].1 <= pair[1].1), "order of arrival");
    for &(number, arrival_ns, to) in &received {
        assert!(arrival_ns >= sent_ns(number) + settings.least_ns, "{number} too early");
        assert_eq!(to, if number % 2 == 0 { To::Vehicle } else { To::Station });
    }
    let mut numbers: Vec<u64> = received.iter().map(|it| it.0).collect();
    assert!(!numbers.is_sorted(), "some overtake others");
    numbers.sort_unstable();
    assert_eq!(numbers, (0..MESSAGES).collect::<Vec<_>>(), "each once");
}

#[test]
fn jitter_has_the_mean_that_is_asked_for() {
    let settings = Settings { loss: 0.0, ..Settings::default() };
    let late = |&(number, arrival_ns, _): &(u64, i64, To)| {
        (arrival_ns - sent_ns(number) - settings.least_ns) as f64
    };
    let received = through(settings, 2);
    let mean = received.iter().map(late).sum::<f64>() / received.len() as f64;
    // Of n draws of an exponential distribution the mean is off by its n^(-1/2)th part: six times that.
    let asked = settings.jitter_ns as f64;
    assert!((mean - asked).abs() < 6.0 * asked / (MESSAGES as f64).sqrt(), "{mean} ns");
}

#[test]
fn about_the_share_asked_for_is_lost() {
    for loss in [0.0, 0.001, 0.1, 0.5, 1.0] {
        let received = through(Settings { loss, ..Settings::default() }, 3);
        let lost = 1.0 - received.len() as f64 / MESSAGES as f64;
        // Six standard deviations of a binomial distribution.
        let off = 6.0 * (loss * (1.0 - loss) / MESSAGES as f64).sqrt();
        assert!((lost - loss).abs() <= off + 1e-12, "{lost} in place of {loss}");
    }
}
