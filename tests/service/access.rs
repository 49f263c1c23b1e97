//! Names, scopes and texts of keys.

use std::collections::HashSet;

use unwrapd::jobs::access::{KeyText, Owner, Scope, Scopes, Visibility};

fn scopes(text: &str) -> Option<Scopes> {
    text.parse().ok()
}

#[test]
fn scopes_are_words_and_admin_alone_is_all() {
    for (text, allowed) in [
        ("read", [true, false, false]),
        ("write", [false, true, false]),
        ("write,read", [true, true, false]),
        ("read, admin", [true, false, true]),
        ("admin", [true, true, true]),
    ] {
        let scopes = scopes(text).expect("scopes");
        let have = [Scope::Read, Scope::Write, Scope::Admin].map(|it| scopes.have(it));
        assert_eq!(have, allowed, "{text}");
        assert_eq!(self::scopes(&scopes.to_string()), Some(scopes));
    }
    for text in ["", "READ", "read,", "all", "read;write"] {
        assert!(scopes(text).is_none(), "{text}");
    }
}

#[test]
fn owners_have_plain_names() {
    let longest = "a".repeat(64);
    for name in ["a", "alice@studio.example", "farm-2_b+c", &longest] {
        let owner: Owner = name.parse().expect("a name");
        assert_eq!(owner.name(), Some(name));
    }
    let too_long = "a".repeat(65);
    for name in ["", "*", "a b", "a\nb", "ä", "a,b", "a/b", &too_long] {
        assert!(name.parse::<Owner>().is_err(), "{name:?}");
    }
    assert_eq!(Owner::anonymous().name(), None);
    let alice: Owner = "alice".parse().expect("a name");
    let own = Visibility::Own(alice.clone());
    assert!(own.covers(&alice) && !own.covers(&Owner::anonymous()));
    assert!(Visibility::All.covers(&alice));
    assert!(!Visibility::Own(Owner::anonymous()).covers(&alice));
}

#[test]
fn a_key_is_its_text_and_shows_no_secret() {
    let key = KeyText::fresh().expect("randomness");
    let text = key.reveal();
    let read = KeyText::parse(&text).expect("a key");
    assert_eq!(read.reveal(), text);
    assert!(read.has_digest(&key.digest()));
    let secret = text.split('_').nth(2).expect("a secret");
    // 32 bytes of randomness, and no more than a digest of them is kept.
    assert_eq!(secret.len(), 64);
    assert!(!format!("{key:?}").contains(secret) && !key.digest().contains(secret));
    for wrong in [
        text.replace("uw_", "sk_"),
        text.to_uppercase(),
        text.replace(key.id().as_str(), "short"),
        text.replacen('_', "", 2),
        String::new(),
    ] {
        assert!(KeyText::parse(&wrong).is_none(), "{wrong}");
    }
    let other = KeyText::fresh().expect("randomness");
    assert!(!other.has_digest(&key.digest()));
    let all: HashSet<String> = (0..100)
        .map(|_| KeyText::fresh().expect("randomness").reveal())
        .collect();
    assert_eq!(all.len(), 100);
}
