//! Webhook addresses.

use std::fmt;
use std::str::FromStr;

use url::Url;

/// Maximum length of an address in bytes, by convention. The address is stored with the job and with its notice.
const MOST: usize = 2048;

/// Address to which the end of a job is posted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Webhook(Url);

/// Error for a text that is not a webhook address.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum WebhookError {
    /// It is not an HTTP address.
    #[error("it is not an address that begins with http:// or https://")]
    NoAddress,
    /// It is too long.
    #[error("it can have at most {MOST} bytes")]
    TooLong,
    /// It has a user name or a password.
    #[error("it must not contain credentials: deliveries are signed")]
    Credentials,
}

impl Webhook {
    /// Returns the address.
    pub fn url(&self) -> &Url {
        &self.0
    }
}

impl fmt::Display for Webhook {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl FromStr for Webhook {
    type Err = WebhookError;

    fn from_str(text: &str) -> Result<Self, WebhookError> {
        if MOST < text.len() {
            return Err(WebhookError::TooLong);
        }
        let url: Url = text.parse().map_err(|_| WebhookError::NoAddress)?;
        if !matches!(url.scheme(), "http" | "https") || url.host().is_none() {
            return Err(WebhookError::NoAddress);
        }
        if !url.username().is_empty() || url.password().is_some() {
            return Err(WebhookError::Credentials);
        }
        Ok(Self(url))
    }
}
