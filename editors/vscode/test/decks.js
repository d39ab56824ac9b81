// The grammar on every deck: comments, strings, numbers and control words are what they are.
const assert = require("assert");
const fs = require("fs");
const path = require("path");
const oniguruma = require("vscode-oniguruma");
const textmate = require("vscode-textmate");

const root = path.join(__dirname, "..", "..", "..");
const grammarFile = path.join(__dirname, "..", "syntaxes", "gibiane.tmLanguage.json");

function decks(folder) {
  return fs.readdirSync(folder, { withFileTypes: true }).flatMap((entry) => {
    const file = path.join(folder, entry.name);
    if (entry.isDirectory()) {
      return decks(file);
    }
    return file.endsWith(".ssi") ? [file] : [];
  });
}

async function main() {
  const wasm = fs.readFileSync(require.resolve("vscode-oniguruma/release/onig.wasm"));
  await oniguruma.loadWASM(wasm.buffer);
  const registry = new textmate.Registry({
    onigLib: Promise.resolve({
      createOnigScanner: (patterns) => new oniguruma.OnigScanner(patterns),
      createOnigString: (text) => new oniguruma.OnigString(text),
    }),
    loadGrammar: async () =>
      textmate.parseRawGrammar(fs.readFileSync(grammarFile, "utf8"), grammarFile),
  });
  const grammar = await registry.loadGrammar("source.gibiane");
  const files = [...decks(path.join(root, "cases")), ...decks(path.join(root, "stdlib"))];
  let words = 0;
  for (const file of files) {
    let stack = textmate.INITIAL;
    let inString = false; // by the language's own rule: a quote opens or closes
    fs.readFileSync(file, "utf8").split("\n").forEach((line, number) => {
      const { tokens, ruleStack } = grammar.tokenizeLine(line, stack);
      stack = ruleStack;
      const scopeAt = (i) =>
        tokens.find((t) => t.startIndex <= i && i < t.endIndex)?.scopes.join(" ") ?? "";
      const expect = (i, scope) => {
        words += 1;
        const where = `${path.relative(root, file)}:${number + 1}:${i + 1}`;
        assert(scopeAt(i).includes(scope), `${where}: ${scope} expected, found ${scopeAt(i)}`);
      };
      if (/^(\*|\$\$\$\$)/.test(line)) {
        expect(0, "comment");
        return;
      }
      for (let i = 0; i < line.length; i += 1) {
        if (line[i] === "'") {
          inString = !inString;
        } else if (inString && line[i - 1] !== "'") {
          assert(/string|property/.test(scopeAt(i)), `${file}:${number + 1}:${i + 1}: no string`);
          words += 1;
        }
      }
      const control = /^\s*(SI|SINON|FINSI|REPE|REPETER|DEBP|DEBPROC|FINP|FINPROC)\b/.exec(line);
      if (control !== null && !inString) {
        expect(control[0].length - 1, "keyword.control");
      }
      const number_ = /^\s*\w+ = (-?\d+\.\d*(?:E-?\d+)?) ;/.exec(line);
      if (number_ !== null) {
        expect(line.indexOf(number_[1], line.indexOf("=")), "constant.numeric");
      }
    });
  }
  console.log(`${files.length} decks, ${words} places: all as the language has them`);
}

main().catch((problem) => {
  console.error(problem.message);
  process.exit(1);
});
