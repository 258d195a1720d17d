//! Finds what can be changed in a source file.

use anyhow::{Context, Result};
use proc_macro2::{Delimiter, TokenStream, TokenTree};
use std::ops::Range;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};

use crate::change::{Change, one_line};
use crate::rules;

/// All changes of a file.
pub(crate) fn changes(file: &str, source: &str) -> Result<Vec<Change>> {
    let parsed = syn::parse_file(source).with_context(|| file.to_owned())?;
    let mut finder = Finder { file, source, offset: 0, root: "crate", within: Vec::new(), found: Vec::new() };
    finder.visit_file(&parsed);
    Ok(finder.found)
}

struct Finder<'a> {
    file: &'a str,
    source: &'a str,
    /// Where in the file the text begins that is parsed.
    offset: usize,
    root: &'static str,
    /// Names of the types and functions around.
    within: Vec<String>,
    found: Vec<Change>,
}

impl Finder<'_> {
    fn range(&self, node: &impl Spanned) -> Range<usize> {
        let range = node.span().byte_range();
        range.start + self.offset..range.end + self.offset
    }

    fn text(&self, node: &impl Spanned) -> &str {
        &self.source[self.range(node)]
    }

    fn add(&mut self, range: Range<usize>, before: &str, text: String) {
        let line = 1 + self.source[..range.start].matches('\n').count();
        self.found.push(Change {
            number: 0,
            file: self.file.to_owned(),
            line,
            function: self.within.join("::"),
            before: one_line(before),
            range,
            text,
            root: self.root,
        });
    }

    fn replace(&mut self, node: &impl Spanned, text: String) {
        let range = self.range(node);
        let before = self.source[range.clone()].to_owned();
        self.add(range, &before, text);
    }

    /// A function: what it may return at once, then what is in it.
    fn function(&mut self, signature: &syn::Signature, block: &syn::Block, walk: impl FnOnce(&mut Self)) {
        if signature.constness.is_some() || block.stmts.is_empty() {
            return;
        }
        self.within.push(signature.ident.to_string());
        let start = self.range(&block.brace_token.span.open()).end;
        for value in rules::returned(&signature.output) {
            self.add(start..start, "body", value.to_owned());
        }
        walk(self);
        self.within.pop();
    }

    /// Parses the right side of each rule of a macro; `$` is read as the beginning of a name.
    fn rules_of_macro(&mut self, tokens: TokenStream) {
        for tree in tokens {
            let TokenTree::Group(group) = tree else { continue };
            let inside = group.span_open().byte_range().end..group.span_close().byte_range().start;
            if !self.part(inside.clone(), group.stream(), false) {
                self.part(inside, group.stream(), true);
            }
        }
    }

    /// Parses a part of a macro; whether it could be. With `blank`, repetitions are left out; where nothing is left, their insides
    /// are parsed.
    fn part(&mut self, range: Range<usize>, tokens: TokenStream, blank: bool) -> bool {
        let mut text = self.source[range.clone()].replace('$', "_");
        let mut inner = Vec::new();
        if blank {
            repetitions(tokens, &mut inner);
            for (whole, ..) in &inner {
                let part = whole.start - range.start..whole.end - range.start;
                let spaces = " ".repeat(part.len());
                text.replace_range(part, &spaces);
            }
            if text.trim().is_empty() {
                return inner.into_iter().any(|(_, inside, tokens)| self.part(inside, tokens, false));
            }
        }
        let outer = (self.offset, self.root);
        (self.offset, self.root) = (range.start, "$crate");
        let parsed = match syn::parse_str::<syn::File>(&text) {
            Ok(file) => {
                self.visit_file(&file);
                true
            }
            Err(_) => false,
        };
        (self.offset, self.root) = outer;
        parsed
    }
}

/// Repetitions `$(…)*` of a macro, outermost: all of it, what is inside, and its tokens.
fn repetitions(tokens: TokenStream, found: &mut Vec<(Range<usize>, Range<usize>, TokenStream)>) {
    let trees: Vec<TokenTree> = tokens.into_iter().collect();
    let mut i = 0;
    while i < trees.len() {
        match (&trees[i], trees.get(i + 1)) {
            (TokenTree::Punct(dollar), Some(TokenTree::Group(group)))
                if dollar.as_char() == '$' && group.delimiter() == Delimiter::Parenthesis =>
            {
                let mut last = i + 1;
                while let Some(TokenTree::Punct(punct)) = trees.get(last + 1) {
                    last += 1;
                    if matches!(punct.as_char(), '*' | '+' | '?') {
                        break;
                    }
                }
                let whole = dollar.span().byte_range().start..trees[last].span().byte_range().end;
                let inside = group.span_open().byte_range().end..group.span_close().byte_range().start;
                found.push((whole, inside, group.stream()));
                i = last;
            }
            (TokenTree::Group(group), _) => repetitions(group.stream(), found),
            _ => {}
        }
        i += 1;
    }
}

/// Whether an item is compiled for tests alone.
fn is_of_tests(attributes: &[syn::Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        attribute.path().is_ident("cfg")
            && attribute.meta.require_list().is_ok_and(|list| list.tokens.to_string() == "test")
    })
}

impl<'ast> Visit<'ast> for Finder<'_> {
    // Constants, types and patterns are settled when the program is compiled: no switch can stand there.
    fn visit_item_const(&mut self, _: &'ast syn::ItemConst) {}
    fn visit_item_static(&mut self, _: &'ast syn::ItemStatic) {}
    fn visit_impl_item_const(&mut self, _: &'ast syn::ImplItemConst) {}
    fn visit_trait_item_const(&mut self, _: &'ast syn::TraitItemConst) {}
    fn visit_expr_const(&mut self, _: &'ast syn::ExprConst) {}
    fn visit_type(&mut self, _: &'ast syn::Type) {}
    fn visit_generics(&mut self, _: &'ast syn::Generics) {}
    fn visit_angle_bracketed_generic_arguments(&mut self, _: &'ast syn::AngleBracketedGenericArguments) {}
    fn visit_path_arguments(&mut self, _: &'ast syn::PathArguments) {}
    fn visit_pat(&mut self, _: &'ast syn::Pat) {}
    fn visit_attribute(&mut self, _: &'ast syn::Attribute) {}
    fn visit_item_enum(&mut self, _: &'ast syn::ItemEnum) {}

    fn visit_item_mod(&mut self, item: &'ast syn::ItemMod) {
        if !is_of_tests(&item.attrs) {
            visit::visit_item_mod(self, item);
        }
    }

    fn visit_item_macro(&mut self, item: &'ast syn::ItemMacro) {
        if let Some(name) = &item.ident {
            self.within.push(format!("{name}!"));
            self.rules_of_macro(item.mac.tokens.clone());
            self.within.pop();
        }
    }

    fn visit_item_impl(&mut self, item: &'ast syn::ItemImpl) {
        if is_of_tests(&item.attrs) {
            return;
        }
        let of = one_line(self.text(&*item.self_ty));
        let name = match &item.trait_ {
            Some((_, path, _)) => format!("<{of} as {}>", one_line(self.text(path))),
            None => of,
        };
        self.within.push(name);
        visit::visit_item_impl(self, item);
        self.within.pop();
    }

    fn visit_item_trait(&mut self, item: &'ast syn::ItemTrait) {
        self.within.push(item.ident.to_string());
        visit::visit_item_trait(self, item);
        self.within.pop();
    }

    fn visit_item_fn(&mut self, item: &'ast syn::ItemFn) {
        if !is_of_tests(&item.attrs) {
            self.function(&item.sig, &item.block, |finder| finder.visit_block(&item.block));
        }
    }

    fn visit_impl_item_fn(&mut self, item: &'ast syn::ImplItemFn) {
        if !is_of_tests(&item.attrs) {
            self.function(&item.sig, &item.block, |finder| finder.visit_block(&item.block));
        }
    }

    fn visit_trait_item_fn(&mut self, item: &'ast syn::TraitItemFn) {
        if let Some(block) = &item.default {
            self.function(&item.sig, block, |finder| finder.visit_block(block));
        }
    }

    fn visit_expr_repeat(&mut self, repeat: &'ast syn::ExprRepeat) {
        self.visit_expr(&repeat.expr);
    }

    fn visit_expr_binary(&mut self, binary: &'ast syn::ExprBinary) {
        let is_bound = rules::binds(&binary.left) || rules::binds(&binary.right);
        for operator in rules::operators(&binary.op).iter().filter(|_| !is_bound) {
            let changed =
                format!("({}) {operator} ({})", self.text(&*binary.left), self.text(&*binary.right));
            self.replace(binary, changed);
        }
        visit::visit_expr_binary(self, binary);
    }

    fn visit_expr_unary(&mut self, unary: &'ast syn::ExprUnary) {
        if matches!(unary.op, syn::UnOp::Neg(_) | syn::UnOp::Not(_)) {
            let inner = self.text(&*unary.expr).to_owned();
            self.replace(unary, inner);
        }
        visit::visit_expr_unary(self, unary);
    }

    fn visit_expr_method_call(&mut self, call: &'ast syn::ExprMethodCall) {
        if let Some(other) = rules::method(&call.method.to_string()) {
            let (all, name) = (self.range(call), self.range(&call.method));
            let changed =
                format!("{}{other}{}", &self.source[all.start..name.start], &self.source[name.end..all.end]);
            self.replace(call, changed);
        }
        if let Some(power) = call.turbofish.as_ref().and_then(rules::number_of_turbofish) {
            let (all, power, other) = (self.range(call), self.range(power), rules::literal(power));
            let [before, after] = [&self.source[all.start..power.start], &self.source[power.end..all.end]];
            let changed = format!("{before}{}{after}", other.unwrap_or_default());
            self.replace(call, changed);
        }
        visit::visit_expr_method_call(self, call);
    }

    fn visit_expr_path(&mut self, path: &'ast syn::ExprPath) {
        let last = path.path.segments.last();
        let other = last
            .filter(|_| path.path.segments.len() > 1)
            .and_then(|last| rules::constant(&last.ident.to_string()));
        if let (Some(last), Some(other)) = (last, other) {
            let (all, name) = (self.range(path), self.range(&last.ident));
            let changed = format!("{}{other}", &self.source[all.start..name.start]);
            self.replace(path, changed);
        }
    }

    fn visit_expr_lit(&mut self, literal: &'ast syn::ExprLit) {
        if let Some(other) = rules::literal(&literal.lit) {
            self.replace(literal, other);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(source: &str) -> Vec<String> {
        let changes = changes("a.rs", source).unwrap();
        changes.into_iter().map(|change| format!("{} → {}", change.before, change.text)).collect()
    }

    #[test]
    fn operators_keep_their_sides() {
        assert_eq!(
            found("fn f(a: T) -> [T; 1] { [a - b * c] }"),
            ["a - b * c → (a) + (b * c)", "b * c → (b) / (c)"]
        );
    }

    #[test]
    fn what_the_compiler_settles_stays() {
        let source = "const A: u8 = 1 + 2; const fn f() -> u8 { 1 + 2 } fn g(x: &[u8; 2 + 1]) -> [u8; 3] { [x[0]; 2 + 1] }";
        assert_eq!(found(source), ["0 → 1"]);
        assert!(found("#[cfg(test)] mod tests { fn f() -> bool { 1 < 2 } }").is_empty());
    }

    #[test]
    fn the_power_of_a_call_is_one_larger() {
        let expected = ["a.pow::<3>() + b → (a.pow::<3>()) - (b)", "a.pow::<3>() → a.pow::<4>()"];
        assert_eq!(found("fn f(a: T) -> [T; 1] { [a.pow::<3>() + b] }"), expected);
    }

    #[test]
    fn macros_are_read_with_their_names() {
        let source = "macro_rules! m { ($T:ty, $f:path) => { impl A for $T { fn g(self) -> Self { $f(self) + self } } }; }";
        assert_eq!(found(source), ["$f(self) + self → ($f(self)) - (self)"]);
        let source =
            "macro_rules! m { ($($T:ty)*) => {$( impl A for $T { fn g(self) -> Self { -self } } )*}; }";
        assert_eq!(found(source), ["-self → self"]);
        let source = "macro_rules! m { ([$($p:tt)*] $T:ty) => { impl<$($p)*> A for $T { fn g(self) -> Self { -self } } }; }";
        assert_eq!(found(source), ["-self → self"]);
    }

    #[test]
    fn a_chain_with_let_keeps_its_operator() {
        assert_eq!(found("fn f() -> [u8; 0] { if let Some(x) = y && x < z {} [] }").len(), 2);
    }
}
