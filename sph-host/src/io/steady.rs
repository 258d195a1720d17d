//! Reading that a signal does not end.

use std::io::{self, ErrorKind, Read, Seek, SeekFrom};

/// Reads again where a signal came between (EINTR): decoders and buffers would take that for an error of the file.
#[derive(Debug)]
pub(in crate::io) struct Steady<R>(pub(in crate::io) R);

impl<R: Read> Read for Steady<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        loop {
            match self.0.read(buffer) {
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                done => return done,
            }
        }
    }

    /// The standard library's own, which reads again and knows how long a file is.
    fn read_to_end(&mut self, bytes: &mut Vec<u8>) -> io::Result<usize> {
        self.0.read_to_end(bytes)
    }
}

impl<R: Seek> Seek for Steady<R> {
    fn seek(&mut self, position: SeekFrom) -> io::Result<u64> {
        self.0.seek(position)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every second call is interrupted.
    struct Restless<'a>(&'a [u8], bool);

    impl Read for Restless<'_> {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            self.1 = !self.1;
            if self.1 { Err(ErrorKind::Interrupted.into()) } else { self.0.read(buffer) }
        }
    }

    #[test]
    fn an_interrupted_call_is_made_again() {
        let mut bytes = [0; 2];
        let mut input = Steady(Restless(b"abcde", false));
        assert_eq!((input.read(&mut bytes).unwrap(), bytes), (2, *b"ab"));
        let mut rest = Vec::new();
        input.read_to_end(&mut rest).unwrap();
        assert_eq!(rest, b"cde");
    }
}
