// Starts the language server, runs and checks scripts in a terminal, opens what a run wrote.
const path = require("path");
const vscode = require("vscode");
const { LanguageClient, TransportKind } = require("vscode-languageclient/node");

let client;

function settings() {
  return vscode.workspace.getConfiguration("ssilang");
}

function command() {
  const [program, ...before] = settings().get("command");
  return { program, before };
}

async function start() {
  const { program, before } = command();
  const language = settings().get("language");
  const server = {
    command: program,
    args: [...before, "lsp", "--lang", language],
    transport: TransportKind.stdio,
  };
  const options = {
    documentSelector: [{ language: "gibiane" }],
    initializationOptions: { language },
  };
  client = new LanguageClient("ssilang", "ssilang", server, options);
  try {
    await client.start();
  } catch (problem) {
    vscode.window.showErrorMessage(
      `The language server did not start: ${problem.message}. ` +
        "It needs pip install 'ssilang[editor]', and ssilang.command in the settings."
    );
  }
}

async function stop() {
  if (client !== undefined && client.isRunning()) {
    await client.stop();
  }
}

function quoted(word) {
  return { value: word, quoting: vscode.ShellQuoting.Strong };
}

async function execute(action) {
  const editor = vscode.window.activeTextEditor;
  if (editor === undefined || editor.document.languageId !== "gibiane") {
    return;
  }
  await editor.document.save();
  const file = editor.document.uri.fsPath;
  const { program, before } = command();
  const words = [...before, action, file, "--lang", settings().get("language")];
  const shell = new vscode.ShellExecution(quoted(program), words.map(quoted), {
    cwd: path.dirname(file),
  });
  const kind = { type: "ssilang", action, file };
  const task = new vscode.Task(kind, vscode.TaskScope.Workspace, action, "ssilang", shell);
  await vscode.tasks.executeTask(task);
}

// Pictures and the summary of the run, which stand in results/NAME beside the script.
async function results() {
  const editor = vscode.window.activeTextEditor;
  if (editor === undefined) {
    return;
  }
  const file = editor.document.uri.fsPath;
  const folder = path.join(path.dirname(file), "results", path.parse(file).name);
  const inside = new vscode.RelativePattern(vscode.Uri.file(folder), "**/*.{png,svg,json,csv,html}");
  const found = await vscode.workspace.findFiles(inside);
  if (found.length === 0) {
    vscode.window.showInformationMessage(`There are no results in ${folder}: run the script first.`);
    return;
  }
  const names = found.map((uri) => path.relative(folder, uri.fsPath)).sort();
  const chosen = await vscode.window.showQuickPick(names, { canPickMany: true });
  for (const name of chosen ?? []) {
    const uri = vscode.Uri.file(path.join(folder, name));
    await vscode.commands.executeCommand("vscode.open", uri, vscode.ViewColumn.Beside);
  }
}

async function activate(context) {
  context.subscriptions.push(
    vscode.commands.registerCommand("ssilang.run", () => execute("run")),
    vscode.commands.registerCommand("ssilang.check", () => execute("check")),
    vscode.commands.registerCommand("ssilang.results", results),
    vscode.commands.registerCommand("ssilang.restart", async () => {
      await stop();
      await start();
    })
  );
  await start();
}

module.exports = { activate, deactivate: stop };
