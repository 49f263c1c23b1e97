//! Stored files as responses: whole, a range, or unchanged (RFC 9110).

use std::ops::Range;

use axum::body::Body;
use axum::http::{HeaderMap, HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};

use super::app::App;
use super::extract::job_not_found;
use super::problem::{Code, Problem};
use crate::jobs::{Job, Undrawn};
use unwrapd_api::{Format, InputFile, OutputFile, Picture};

/// Formats with a media type in responses, as in the OpenAPI document. Files of other formats are plain bytes.
const TYPED: [Format; 7] = [
    Format::Glb,
    Format::Gltf,
    Format::Obj,
    Format::Json,
    Format::Png,
    Format::Txt,
    Format::Csv,
];

/// A file of a job.
#[derive(Clone, Copy)]
pub(super) enum StoredFile<'a> {
    /// An output file.
    Output(&'a OutputFile),
    /// A picture of its result, which the job can have.
    Picture(Picture),
    /// An input file with its index.
    Input(usize, &'a InputFile),
}

impl<'a> StoredFile<'a> {
    fn name(&self) -> &str {
        match self {
            Self::Output(file) => &file.name,
            Self::Picture(picture) => picture.role(),
            Self::Input(_, file) => &file.name,
        }
    }

    /// Returns the entity tag: job and index for an input, job, token and role otherwise. Files never change.
    fn tag(&self, job: &Job) -> String {
        match self {
            Self::Output(file) => {
                let role = file.role.replace('/', "-");
                format!("\"{}-{}-{role}\"", job.id, job.token)
            }
            Self::Picture(picture) => format!("\"{}-{}-{}\"", job.id, job.token, picture.role()),
            Self::Input(index, _) => format!("\"{}-input-{index}\"", job.id),
        }
    }

    /// Opens the file; draws a picture that is not stored.
    async fn open(self, app: &App, job: &Job) -> Result<OpenFile<'a>, Problem> {
        Ok(match self {
            Self::Output(file) => OpenFile::Output(file),
            Self::Input(_, file) => OpenFile::Input(file),
            Self::Picture(wanted) => OpenFile::Picture(picture(app, job, wanted).await?),
        })
    }
}

/// A file of known size.
enum OpenFile<'a> {
    Output(&'a OutputFile),
    Input(&'a InputFile),
    Picture(Vec<u8>),
}

impl OpenFile<'_> {
    fn bytes(&self) -> u64 {
        match self {
            Self::Output(file) => file.bytes,
            Self::Input(file) => file.bytes,
            Self::Picture(content) => content.len() as u64,
        }
    }

    async fn read(self, app: &App, job: &Job, part: Range<u64>) -> Result<Body, Problem> {
        Ok(match self {
            Self::Output(file) => Body::from_stream(app.jobs.read(job, file, part).await?),
            Self::Input(file) => Body::from_stream(app.jobs.read_input(job, file, part).await?),
            Self::Picture(content) => {
                Body::from(content[part.start as usize..part.end as usize].to_vec())
            }
        })
    }
}

/// Returns a picture of a job.
pub(super) async fn picture(app: &App, job: &Job, picture: Picture) -> Result<Vec<u8>, Problem> {
    Ok(app.jobs.picture(job, picture).await?)
}

impl From<Undrawn> for Problem {
    fn from(undrawn: Undrawn) -> Self {
        match undrawn {
            Undrawn::Removed => job_not_found(),
            Undrawn::Failed(failure) => Self::of_failure(&failure),
            Undrawn::Store(error) => error.into(),
        }
    }
}

/// Responds with a file of a job, or with the requested range of it.
pub(super) async fn answer(
    app: &App,
    job: &Job,
    file: StoredFile<'_>,
    headers: &HeaderMap,
) -> Result<Response, Problem> {
    let tag = file.tag(job);
    // Compare the entity tag with the client's copy.
    if names(headers, header::IF_NONE_MATCH, &tag) {
        return Ok((StatusCode::NOT_MODIFIED, [(header::ETAG, tag)]).into_response());
    }
    let opened = file.open(app, job).await?;
    let bytes = opened.bytes();
    let is_same =
        (headers.get(header::IF_RANGE)).is_none_or(|given| given.as_bytes() == tag.as_bytes());
    // Find the requested range. If the file has changed since the client's first part, send all of it.
    let range = match headers.get(header::RANGE).filter(|_| is_same) {
        Some(value) => range(value, bytes),
        None => Ok(None),
    };
    let Ok(range) = range else {
        let detail = format!("the file has {bytes} bytes");
        let problem = Problem::new(Code::RangeNotSatisfiable, detail).with_limit(bytes);
        let size = [(header::CONTENT_RANGE, format!("bytes */{bytes}"))];
        return Ok((size, problem).into_response());
    };
    // Send the content with its headers.
    let part = range.clone().unwrap_or(0..bytes);
    let content = opened.read(app, job, part.clone()).await?;
    let length = part.end - part.start;
    let mut response = content.into_response();
    let headers = response.headers_mut();
    for (name, value) in [
        (header::CONTENT_TYPE, content_type(file.name())),
        (header::CONTENT_LENGTH, length.to_string()),
        (header::CONTENT_DISPOSITION, disposition(file.name())),
        (header::ACCEPT_RANGES, "bytes".to_owned()),
        (header::CACHE_CONTROL, "private, no-cache".to_owned()),
        (header::ETAG, tag),
    ] {
        if let Ok(value) = HeaderValue::from_str(&value) {
            headers.insert(name, value);
        }
    }
    if range.is_some() {
        let range = format!("bytes {}-{}/{bytes}", part.start, part.end - 1);
        let range = HeaderValue::from_str(&range);
        headers.extend(range.map(|range| (header::CONTENT_RANGE, range)));
        *response.status_mut() = StatusCode::PARTIAL_CONTENT;
    }
    Ok(response)
}

/// Returns whether a header lists this tag, strong or weak: proxies that compress weaken tags.
pub(super) fn names(headers: &HeaderMap, name: header::HeaderName, tag: &str) -> bool {
    headers
        .get_all(name)
        .iter()
        .filter_map(|value| value.to_str().ok())
        .flat_map(|value| value.split(','))
        .map(str::trim)
        .any(|given| given == "*" || given.strip_prefix("W/").unwrap_or(given) == tag)
}

/// Parses a Range header with a single range. Ignores anything else, as RFC 9110 asks. Returns `Err` if the range
/// contains no byte of the file.
fn range(value: &HeaderValue, size: u64) -> Result<Option<Range<u64>>, ()> {
    let spec = value
        .to_str()
        .ok()
        .and_then(|text| text.strip_prefix("bytes="));
    let Some((first, last)) = spec.and_then(|spec| spec.split_once('-')) else {
        return Ok(None);
    };
    let range = match (first.trim().parse::<u64>(), last.trim().parse::<u64>()) {
        (Ok(first), Ok(last)) if first <= last => first..size.min(last.saturating_add(1)),
        (Ok(first), Err(_)) if last.trim().is_empty() => first..size,
        (Err(_), Ok(count)) if first.trim().is_empty() => size - size.min(count)..size,
        _ => return Ok(None),
    };
    if range.is_empty() {
        Err(())
    } else {
        Ok(Some(range))
    }
}

fn content_type(name: &str) -> String {
    let format = Format::of_name(name).filter(|format| TYPED.contains(format));
    match format.and_then(|format| format.media_types().first()) {
        Some(text) if text.starts_with("text/") => format!("{text}; charset=utf-8"),
        Some(media_type) => (*media_type).to_owned(),
        None => "application/octet-stream".to_owned(),
    }
}

/// Returns the Content-Disposition: pictures and reports are shown, other files are saved. The name is given in
/// ASCII, and also in UTF-8 if it has other characters.
fn disposition(name: &str) -> String {
    let kind = match Format::of_name(name) {
        Some(Format::Png | Format::Json) => "inline",
        _ => "attachment",
    };
    let ascii: String = name
        .chars()
        .map(|c| match c {
            '.' | '-' | '_' | ' ' => c,
            _ if c.is_ascii_alphanumeric() => c,
            _ => '_',
        })
        .collect();
    if ascii == name {
        return format!("{kind}; filename=\"{ascii}\"");
    }
    let encoded = percent_encoding::utf8_percent_encode(name, percent_encoding::NON_ALPHANUMERIC);
    format!("{kind}; filename=\"{ascii}\"; filename*=UTF-8''{encoded}")
}
