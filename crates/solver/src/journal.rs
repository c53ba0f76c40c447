//! Journals: files of lines that are only ever appended, by one process at a time.
//!
//! The first line says what a journal is about; every line has a checksum of itself and of the line before, so that none is
//! left out, comes twice or passes into another file. A process that is killed leaves at most one line that is cut off, which
//! is no line.

use crate::hexadecimal::hexadecimal;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{Error, ErrorKind, Read, Result, Seek, SeekFrom, Write};
use std::path::Path;

/// What journals of a kind begin with.
#[derive(Debug, Clone, Copy)]
pub struct Kind {
    /// What such a file says that it is.
    pub name: &'static str,
    /// The format of what is in it.
    pub version: u32,
}

#[derive(Serialize, Deserialize)]
struct First<H> {
    krawl: String,
    version: u32,
    #[serde(flatten)]
    about: H,
}

/// What is whole in a journal.
#[derive(Debug)]
pub struct Whole<H, L> {
    /// What it is about.
    pub about: H,
    /// The lines behind the first.
    pub lines: Vec<L>,
    /// The number of the first line that is damaged, if one is: nothing is taken from there on.
    pub damaged: Option<usize>,
    /// What the next line is bound to.
    last: String,
    length: u64,
}

/// A journal that this process writes.
#[derive(Debug)]
pub struct Journal {
    file: File,
    /// What the next line is bound to: the first one's text, or the checksum of the line before.
    last: String,
    /// How much of the file is whole.
    length: u64,
    /// Whether there may be more behind. That is cut off when the next line is written, not before: what is refused is left as
    /// it is.
    is_torn: bool,
}

fn json<T: Serialize>(what: &T) -> String {
    serde_json::to_string(what).expect("strings, numbers and lists have a form in JSON")
}

fn checksum(before: &str, text: &str) -> String {
    let digest = Sha256::new().chain_update(before).chain_update(text);
    hexadecimal(&digest.finalize())
}

/// A line behind another, and what the next one is bound to.
fn line<L: Serialize>(last: &str, of: &L) -> (String, String) {
    let text = json(of);
    let sum = checksum(last, &text);
    (format!("{sum} {text}\n"), sum)
}

impl Kind {
    fn first<H: Serialize>(&self, about: H) -> String {
        json(&First {
            krawl: self.name.to_owned(),
            version: self.version,
            about,
        })
    }

    /// The bytes of a journal.
    pub fn text<H: Serialize, L: Serialize>(&self, about: &H, lines: &[L]) -> String {
        let mut last = self.first(about);
        let mut out = format!("{last} {}\n", checksum("", &last));
        for of in lines {
            let (text, sum) = line(&last, of);
            out += &text;
            last = sum;
        }
        out
    }

    /// What is whole in the bytes of a journal; `None` where it was cut off before the end of its first line.
    pub fn read<H, L>(&self, bytes: &[u8]) -> Result<Option<Whole<H, L>>>
    where
        H: Serialize + DeserializeOwned,
        L: DeserializeOwned,
    {
        let broken = |what: String| Error::new(ErrorKind::InvalidData, what);
        let begin = format!(r#"{{"krawl":"{}","#, self.name);
        if !bytes.iter().zip(begin.as_bytes()).all(|(a, b)| a == b) {
            let what = format!("it does not begin as `{}` of krawl does", self.name);
            return Err(broken(what));
        }
        let mut rest = bytes.split_inclusive(|&b| b == b'\n');
        let text = |line: &[u8]| String::from_utf8(line.strip_suffix(b"\n")?.to_vec()).ok();
        let length = rest.next().map_or(0, <[u8]>::len);
        if !bytes[..length].ends_with(b"\n") {
            return Ok(None);
        }
        #[derive(Deserialize)]
        struct Format {
            version: u32,
        }
        let damaged = || broken("its first line is damaged".to_owned());
        let line = text(&bytes[..length]).ok_or_else(damaged)?;
        // Others may have no checksum, or another.
        let format = serde_json::Deserializer::from_str(&line)
            .into_iter::<Format>()
            .next();
        let Format { version } = format.ok_or_else(damaged)?.map_err(|_| damaged())?;
        if version != self.version {
            return Err(broken(format!(
                "another version of krawl wrote it, in format {version}; this one has format {}",
                self.version
            )));
        }
        let (first, sum) = line.rsplit_once(' ').ok_or_else(damaged)?;
        if checksum("", first) != sum {
            return Err(damaged());
        }
        let First { about, .. } = serde_json::from_str::<First<H>>(first).map_err(|_| damaged())?;
        let mut whole = Whole {
            // What lines were written behind, however the first one is spelled.
            last: self.first(&about),
            about,
            lines: Vec::new(),
            damaged: None,
            length: length as u64,
        };
        for bytes in rest.take_while(|line| line.ends_with(b"\n")) {
            let found = text(bytes).and_then(|line| {
                let (sum, text) = line.split_once(' ')?;
                let right = checksum(&whole.last, text) == sum;
                let found = right.then(|| serde_json::from_str(text).ok())??;
                Some((found, sum.to_owned()))
            });
            let Some((found, sum)) = found else {
                whole.damaged = Some(whole.lines.len() + 2);
                break;
            };
            whole.lines.push(found);
            whole.last = sum;
            whole.length += bytes.len() as u64;
        }
        Ok(Some(whole))
    }

    /// Opens a journal, or makes one, and reads what is whole in it. [`ErrorKind::WouldBlock`]: another process writes it.
    pub fn open<H, L>(&self, path: &Path) -> Result<(Journal, Option<Whole<H, L>>)>
    where
        H: Serialize + DeserializeOwned,
        L: DeserializeOwned,
    {
        let mut options = OpenOptions::new();
        options.read(true).write(true).create(true).truncate(false);
        let mut file = options.open(path)?;
        file.try_lock().map_err(|error| match error {
            TryLockError::WouldBlock => ErrorKind::WouldBlock.into(),
            TryLockError::Error(error) => error,
        })?;
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes)?;
        let whole = self.read(&bytes)?;
        let known = whole.as_ref();
        let journal = Journal {
            file,
            last: known.map_or(String::new(), |whole| whole.last.clone()),
            length: known.map_or(0, |whole| whole.length),
            is_torn: true,
        };
        Ok((journal, whole))
    }
}

impl Journal {
    /// Begins an empty one.
    pub fn begin<H: Serialize>(&mut self, kind: &Kind, about: &H) -> Result<()> {
        self.append(&kind.text::<H, ()>(about, &[]), kind.first(about))
    }

    /// Adds a line.
    pub fn put<L: Serialize>(&mut self, of: &L) -> Result<()> {
        assert!(
            !self.last.is_empty(),
            "a journal is begun before it is filled"
        );
        let (text, sum) = line(&self.last, of);
        self.append(&text, sum)
    }

    /// Waits until all of it is on the disk.
    pub fn sync(&self) -> Result<()> {
        self.file.sync_data()
    }

    fn append(&mut self, text: &str, last: String) -> Result<()> {
        if self.is_torn {
            self.file.set_len(self.length)?;
            self.file.seek(SeekFrom::Start(self.length))?;
        }
        // A line may be cut off where the disk is full.
        self.is_torn = true;
        self.file.write_all(text.as_bytes())?;
        (self.is_torn, self.last) = (false, last);
        self.length += text.len() as u64;
        Ok(())
    }
}
