//! Handles dragged at random.

use std::time::{Duration, Instant};

use serde_json::json;
use unwrapd::numerics::random::Random;

use crate::cases::Case;
use crate::harness::live::{Heard, Live};
use crate::service::Service;

/// Drags at random: runs of moves at various speeds, jumps, letting go and holding again, undo.
pub async fn drag(case: &Case, time: Duration) {
    let service = Service::start(1);
    let mut session = service.open(case).await;
    let mut random = Random::new(1);
    let (begin, mut early) = (Instant::now(), None);
    let (mut moves, mut frames, mut worst) = (0, 0, 0.0_f64);
    let mut to = case.dragged.clone();
    while begin.elapsed() < time {
        stray(case, &mut to, &mut random);
        let sent = Instant::now();
        let n = say(case, &mut session.live, &mut to, random.below(200)).await;
        let mut is_answered = false;
        while !is_answered {
            if let Heard::Frame(frame) = session.live.hear().await {
                is_answered = n <= frame.message;
                if is_answered {
                    worst = worst.max(1e3 * sent.elapsed().as_secs_f64());
                }
                session.live.judge(&frame);
                frames += 1;
            }
        }
        moves += 1;
        if early.is_none() && begin.elapsed() > time / 10 {
            early = Some(service.resident());
        }
    }
    println!(
        "{}: dragged for {:.0} s: {moves} moves, {frames} frames without a flip, longest wait {worst:.0} ms; {} MiB after a tenth, {} MiB \
         at the end",
        case.name,
        time.as_secs_f64(),
        early.unwrap_or_default(),
        service.resident(),
    );
    service.close(&session).await;
}

/// The next place, near or far.
fn stray(case: &Case, to: &mut [f64], random: &mut Random) {
    let speed = case.reach * 0.5 * random.unit().powi(3);
    let limit = 3.0 * case.reach;
    for (x, center) in to.iter_mut().zip(&case.dragged) {
        let next = *x + speed * (2.0 * random.unit() - 1.0);
        *x = next.clamp(center - limit, center + limit);
    }
}

/// Says a move, or now and then something else, after which both handles are held again; the number of the last message.
async fn say(case: &Case, live: &mut Live, to: &mut Vec<f64>, chance: usize) -> u32 {
    let (wish, lets_go) = match chance {
        0 => (json!({ "undo": {} }), true),
        1 => (json!({ "remember": {} }), false),
        2 => (json!({ "reset": {} }), true),
        3 => (json!({ "remove": { "name": 1 } }), true),
        _ => (json!({ "move": { "name": 1, "to": to } }), false),
    };
    let mut n = live.say(wish).await;
    if lets_go {
        to.clone_from(&case.dragged);
        for (name, center) in [(0, &case.held), (1, &case.dragged)] {
            let add = json!({ "name": name, "handle": case.disc(center) });
            n = live.say(json!({ "add": add })).await;
        }
    }
    n
}
