//! Lines of values in a JSON text.

/// Finds values by their paths. The text is valid JSON.
pub struct Locator<'a> {
    text: &'a [u8],
    at: usize,
}

impl<'a> Locator<'a> {
    /// Searches this text.
    pub fn new(text: &'a str) -> Locator<'a> {
        Locator { text: text.as_bytes(), at: 0 }
    }

    /// Line, from 1, of the value with these keys, or of element `index` of that array.
    pub fn line(mut self, keys: &[&str], index: Option<usize>) -> Option<usize> {
        for key in keys {
            self.enter_key(key)?;
        }
        if let Some(index) = index {
            self.enter_element(index)?;
        }
        Some(self.here())
    }

    /// Line, from 1, of the value at a path such as `partitions.list[2].near`.
    pub fn line_of(mut self, path: &str) -> Option<usize> {
        for step in path.split('.') {
            let (key, index) = step
                .split_once('[')
                .map_or((step, None), |(key, rest)| (key, rest.trim_end_matches(']').parse().ok()));
            self.enter_key(key)?;
            if let Some(index) = index {
                self.enter_element(index)?;
            }
        }
        Some(self.here())
    }

    /// Line of what comes next.
    fn here(&mut self) -> usize {
        self.space();
        1 + self.text[..self.at].iter().filter(|&&b| b == b'\n').count()
    }

    /// Moves to an element of the array that begins here.
    fn enter_element(&mut self, index: usize) -> Option<()> {
        self.expect(b'[')?;
        for _ in 0..index {
            self.skip_value()?;
            self.expect(b',')?;
        }
        Some(())
    }

    fn peek(&self) -> Option<u8> {
        self.text.get(self.at).copied()
    }

    fn space(&mut self) {
        while self.peek().is_some_and(|b| b.is_ascii_whitespace()) {
            self.at += 1;
        }
    }

    fn expect(&mut self, byte: u8) -> Option<()> {
        self.space();
        if self.peek()? != byte {
            return None;
        }
        self.at += 1;
        Some(())
    }

    /// Moves to the value of a key of the object that begins here.
    fn enter_key(&mut self, key: &str) -> Option<()> {
        self.expect(b'{')?;
        loop {
            self.space();
            let start = self.at + 1;
            self.skip_value()?;
            let found = self.text.get(start..self.at.checked_sub(1)?)?;
            self.expect(b':')?;
            if found == key.as_bytes() {
                return Some(());
            }
            self.skip_value()?;
            self.expect(b',')?;
        }
    }

    /// Moves behind the value that begins here.
    fn skip_value(&mut self) -> Option<()> {
        self.space();
        let mut depth = 0;
        loop {
            match self.peek()? {
                b'"' => self.skip_string()?,
                b'[' | b'{' => {
                    depth += 1;
                    self.at += 1;
                }
                b']' | b'}' => {
                    depth -= 1;
                    self.at += 1;
                }
                _ => self.at += 1,
            }
            if depth == 0 && matches!(self.peek(), None | Some(b',' | b':' | b']' | b'}')) {
                return Some(());
            }
            if depth == 0 && self.peek().is_some_and(|b| b.is_ascii_whitespace()) {
                return Some(());
            }
        }
    }

    fn skip_string(&mut self) -> Option<()> {
        self.at += 1;
        while self.peek()? != b'"' {
            self.at += if self.peek()? == b'\\' { 2 } else { 1 };
        }
        self.at += 1;
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = r#"{
  "a\"b" : [1, {"x": "]"}, [2,
     3]],
  "list": [
    [1, 2], "x,y",
    {"k": [0]}
    , 7],
  "deep": {"inner":
     5}
}"#;

    #[test]
    fn lines_of_values() {
        let line = |keys: &[&str], index| Locator::new(TEXT).line(keys, index);
        assert_eq!(line(&["list"], None), Some(4));
        assert_eq!(line(&["list"], Some(0)), Some(5));
        assert_eq!(line(&["list"], Some(1)), Some(5));
        assert_eq!(line(&["list"], Some(2)), Some(6));
        assert_eq!(line(&["list"], Some(3)), Some(7));
        assert_eq!(line(&["list"], Some(4)), None);
        assert_eq!(line(&["deep", "inner"], None), Some(9));
        assert_eq!(line(&["none"], None), None);
        assert_eq!(Locator::new(TEXT).line_of("list[2].k[0]"), Some(6));
        assert_eq!(Locator::new(TEXT).line_of("deep.inner"), Some(9));
        assert_eq!(Locator::new(TEXT).line_of("list[2].none"), None);
        assert_eq!(line(&[r#"a\"b"#], Some(2)), Some(2));
        assert_eq!(Locator::new("").line(&["a"], None), None);
        assert_eq!(Locator::new(r#"{"a"#).line(&["a"], None), None);
    }
}
