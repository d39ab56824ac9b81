"""What ssilang/cli refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "range-no-values-first": Message(
        "the range {text} has no values: it is first:last:step",
        "l'intervalle {text} n'a pas de valeurs : il s'écrit premier:dernier:pas",
    ),
    "not-name-value-ag": Message(
        "'{text}' is not NAME=VALUE, such as AG=0.3 or AG=0.1:1.0:0.1",
        "'{text}' n'est pas NOM=VALEUR, comme AG=0.3 ou AG=0.1:1.0:0.1",
    ),
    "nothing-sweep-set-name": Message(
        "nothing to sweep: give --set NAME=VALUES or --motions DIR",
        "rien à faire varier : donnez --set NOM=VALEURS ou --motions REPERTOIRE",
    ),
    "not-folder-ground-motions": Message(
        "{folder} is not a folder of ground motions",
        "{folder} n'est pas un répertoire d'accélérogrammes",
    ),
    "no-file": Message(
        "there is no ground motion in {folder}",
        "il n'y a pas d'accélérogramme dans {folder}",
        "a motion is a text with lines of numbers: .AT2, .csv ...",
        "un accélérogramme est un texte avec des lignes de nombres : .AT2, .csv ...",
    ),
    "set-twice": Message(
        "{name} is set twice",
        "{name} est donné deux fois",
    ),
    "cluster-needs-dask-distributed": Message(
        "a cluster needs dask.distributed: pip install 'ssilang[cluster]'",
        "un cluster demande dask.distributed : pip install 'ssilang[cluster]'",
    ),
    "several-values": Message(
        "{text} gives {name} several values: that is a sweep",
        "{text} donne à {name} plusieurs valeurs : c'est un balayage",
    ),
    "no-such-parameter": Message(
        "a value is given to {name}, that the script does not have",
        "une valeur est donnée à {name}, que le jeu de données n'a pas",
        "{near:?did you mean {near}?|{known:?its names are {known:and}}}",
        "{near:?vouliez-vous dire {near} ?|{known:?ses noms sont {known:and}}}",
    ),
    "range-values": Message(
        "the range {text} has {count} {count:value|values}",
        "l'intervalle {text} a {count} {count:valeur|valeurs}",
    ),
    "runs-done": Message(
        "{done} of {total} runs are done already",
        "{done} calculs sur {total} sont déjà faits",
    ),
    "runs-again": Message(
        "{count} {count:run|runs} again: {reason}",
        "{count} {count:calcul refait|calculs refaits} : {reason}",
    ),
    "again-version": Message(
        "made by ssilang {before}, this is {now}",
        "{before} de ssilang les a faits, celui-ci est {now}",
    ),
    "again-deck": Message("the deck has changed", "le jeu de données a changé"),
    "again-values": Message("other values were given", "d'autres valeurs étaient données"),
    "again-files": Message(
        "{files} {files:has|have} changed",
        "{files} {files:a|ont} changé",
    ),
    "again-unknown": Message(
        "what was left does not say what it was made with",
        "ce qui en reste ne dit pas avec quoi cela a été fait",
    ),
    "files-no-motions": Message(
        "left out, no {count:motion|motions}: {names}",
        "{count:laissé de côté, pas un mouvement|laissés de côté, pas des mouvements} : {names}",
    ),
    "run-failed": Message(
        "run {number} failed: {error} (runs/{folder})",
        "le calcul {number} a échoué : {error} (runs/{folder})",
    ),
    "swept": Message(
        "{runs} {runs:run|runs}, {failed} failed; {table}, {pictures} {pictures:picture|pictures}"
        "{histories:?, {histories} joined {histories:history|histories}}",
        "{runs} {runs:calcul|calculs}, {failed} en échec ; {table}, {pictures} "
        "{pictures:image|images}{histories:?, {histories} {histories:histoire réunie|histoires "
        "réunies}}",
    ),
    "no-working-folder": Message(
        "the working folder was removed",
        "le dossier de travail a été supprimé",
        "go to a folder that is there (cd)",
        "allez dans un dossier qui existe (cd)",
    ),
    "no-bound-on-memory": Message(
        "this system cannot bound the memory of a process (--max-memory)",
        "ce système ne peut borner la mémoire d'un processus (--max-memory)",
        "leave --max-memory out",
        "ôtez --max-memory",
    ),
    "kept-folder-refused": Message(
        "others could have put code or words into {folder}: nothing is read from there or kept, "
        "this run makes them anew",
        "d'autres ont pu mettre du code ou des mots dans {folder} : rien n'y est lu ni conservé, "
        "ce calcul les refait",
        "{fault} must belong to you, be no link, and not let others write (chmod 700)",
        "{fault} doit vous appartenir, ne pas être un lien et ne pas laisser écrire les autres "
        "(chmod 700)",
    ),
    "files-written": Message(
        "{count} {count:file|files} in {folder}, {warnings} {warnings:warning|warnings}"
        "{energy:?, {off:?energies out of balance by|energy within} {energy} %}"
        "{amount:? ({amount})}",
        "{count} {count:fichier|fichiers} dans {folder}, {warnings} "
        "{warnings:avertissement|avertissements}{energy:?, {off:?écart des énergies de {energy} %|"
        "énergie à {energy} % près}}{amount:? ({amount})}",
    ),
    "runs": Message("runs", "calculs"),
    # ---- the interactive session
    "welcome": Message(
        "ssilang {version}. Statements end with ;   INFO NAME ; shows help, %help the commands, "
        "FIN ; leaves.",
        "ssilang {version}. Une instruction finit par ;   INFO NOM ; montre l'aide, %help les "
        "commandes, FIN ; fait sortir.",
    ),
    "commands": Message(
        """%help            this list
%vars            the objects of the session
%save FILE       write the statements that ran to a script
%run FILE        run a script in this session
%quit            leave (also FIN ; or Ctrl-D)
Ctrl-C stops what runs, or forgets what is being typed; Tab completes.""",
        """%help            cette liste
%vars            les objets de la session
%save FICHIER    écrire les instructions exécutées dans un script
%run FICHIER     exécuter un script dans cette session
%quit            sortir (ou FIN ; ou Ctrl-D)
Ctrl-C arrête le calcul en cours, ou oublie ce qui est tapé ; Tab complète.""",
    ),
    "no-such-command": Message(
        "there is no command {name}; %help lists them",
        "il n'y a pas de commande {name} ; %help en donne la liste",
    ),
    "lines-saved": Message(
        "{count} {count:line|lines} written to {path}",
        "{count} {count:ligne écrite|lignes écrites} dans {path}",
    ),
    "file-name-wanted": Message("{name} needs a file's name", "{name} demande un nom de fichier"),
    "session-goes-on": Message(
        "interrupted; the session goes on", "interrompu ; la session continue"
    ),
    # ---- help
    "no-help": Message("there is no help about {word}", "il n'y a pas d'aide sur {word}"),
    "list-of-help": Message(
        "`ssilang help` lists all of them", "`ssilang help --lang fr` en donne la liste"
    ),
    "plain-numba": Message(
        "compiled code is made by plain numba{untried:?, since ssilang's own ways were not tried "
        "with {untried}|, as SSILANG_PLAIN_NUMBA says}: the same answers, longer starts",
        "le code compilé est fait par numba seul{untried:?, car les voies propres à ssilang n'ont "
        "pas été essayées avec {untried}|, comme le dit SSILANG_PLAIN_NUMBA} : mêmes réponses, "
        "départs plus longs",
    ),
    "sweep-in-one-process": Message(
        "processes cannot work together on this system (is /dev/shm missing, or closed?): the "
        "runs go one after the other in this one",
        "des processus ne peuvent travailler ensemble sur ce système (/dev/shm manque-t-il, ou "
        "est-il fermé ?) : les calculs se suivent dans celui-ci",
    ),
    "warm-nothing-kept": Message(
        "compiled code would end with this process",
        "le code compilé finirait avec ce processus",
        "unset SSILANG_PLAIN_NUMBA, and give the user a home folder, or NUMBA_CACHE_DIR, that "
        "nobody else can write to",
        "enlevez SSILANG_PLAIN_NUMBA, et donnez à l'utilisateur un répertoire personnel, ou "
        "NUMBA_CACHE_DIR, où personne d'autre ne peut écrire",
    ),
    "warm-deck": Message(
        "{deck}: {count} {count:function|functions} compiled, {seconds:.1f} s",
        "{deck} : {count} {count:fonction compilée|fonctions compilées}, {seconds:.1f} s",
    ),
    "warmed": Message(
        "{count} {count:function|functions} compiled for {decks} {decks:deck|decks} in "
        "{seconds:.0f} s; {folder} keeps {kept}",
        "{count} {count:fonction compilée|fonctions compilées} pour {decks} "
        "{decks:jeu|jeux} de données en {seconds:.0f} s ; {folder} en garde {kept}",
    ),
    # ---- usage of the command line
    "usage": Message("usage: ", "utilisation : "),
    "usage-positional": Message("positional arguments", "arguments"),
    "usage-options": Message("options", "options"),
    "usage-program": Message(
        "Runs Gibiane scripts for soil-structure interaction with uplift.",
        "Exécute des scripts Gibiane pour l'interaction sol-structure avec décollement.",
    ),
    "usage-short": Message(
        "ssilang case.ssi is short for ssilang run case.ssi; ssilang alone is interactive.",
        "ssilang cas.ssi abrège ssilang run cas.ssi ; ssilang seul est interactif.",
    ),
    "usage-help": Message("show this help and exit", "affiche cette aide et s'arrête"),
    "usage-version-option": Message(
        "show the program's version and exit", "affiche la version du programme et s'arrête"
    ),
    "usage-run": Message(
        "run a script (- for standard input)", "exécute un script (- pour l'entrée standard)"
    ),
    "usage-report": Message(
        "report.html of a folder of results", "report.html d'un répertoire de résultats"
    ),
    "usage-report-folder": Message(
        "folder of a run or a sweep, such as results/case",
        "répertoire d'un calcul ou d'un balayage, comme results/cas",
    ),
    "usage-report-option": Message(
        "write report.html into the output folder: checks, energies, curves, the footing in "
        "contact, the scene that turns and plays",
        "écrire report.html dans le répertoire des résultats : vérifications, énergies, courbes, "
        "semelle en contact, scène qui tourne et se joue",
    ),
    "usage-report-example": Message(
        "Example: ssilang run tower.ssi --report writes results/tower/report.html, one file that "
        "opens in any browser; ssilang report results/tower --lang fr makes it again, in French.",
        "Exemple : ssilang run tour.ssi --report écrit results/tour/report.html, un seul fichier "
        "qui s'ouvre dans tout navigateur ; ssilang report results/tour --lang en le refait, en "
        "anglais.",
    ),
    "usage-check": Message("report mistakes without running", "signale les fautes sans exécuter"),
    "usage-help-of": Message(
        "help of a word, or what is known about it", "aide d'un mot, ou ce qu'on en sait"
    ),
    "histories-other-columns": Message(
        "{count} {count:table of a run has|tables of runs have} other columns than those of the "
        "first run: not joined",
        "{count} {count:table de calcul a|tables de calculs ont} d'autres colonnes que celles du "
        "premier : non {count:réunie|réunies}",
    ),
    "histories-too-large": Message(
        "too large to be joined: {names}",
        "trop gros pour être réunis : {names}",
    ),
    "usage-report-sweep": Message(
        "write report.html of the sweep, and of each run: table of runs, figures over what was "
        "swept",
        "écrire report.html du balayage, et de chaque calcul : table des calculs, valeurs selon ce "
        "qui varie",
    ),
    "usage-sweep": Message(
        "run a script over parameters and motions",
        "exécute un script pour plusieurs paramètres et accélérogrammes",
    ),
    "usage-warm": Message(
        "compile what scripts need, for images and clusters",
        "compile ce que demandent des scripts, pour les images et les clusters",
    ),
    "usage-warm-files": Message(
        "scripts to run for it (default: those that come with the program)",
        "scripts à exécuter pour cela (par défaut ceux qui viennent avec le programme)",
    ),
    "usage-warm-example": Message(
        "Example, in the recipe of an image: RUN pip install ssilang && ssilang warm. Each user "
        "of a machine has his own compiled code, unless NUMBA_CACHE_DIR names a folder.",
        "Exemple, dans la recette d'une image : RUN pip install ssilang && ssilang warm. Chaque "
        "utilisateur d'une machine a son propre code compilé, sauf si NUMBA_CACHE_DIR nomme un "
        "répertoire.",
    ),
    "usage-repl": Message("interactive session", "session interactive"),
    "usage-version": Message("version of the program", "version du programme"),
    "usage-file": Message("script, or - for standard input", "script, ou - pour l'entrée standard"),
    "usage-file-alone": Message("script", "script"),
    "usage-files": Message("scripts", "scripts"),
    "usage-word": Message(
        "operator, procedure, keyword, entry ...; none lists all",
        "opérateur, procédure, mot-clé, indice... ; sans mot, la liste de tous",
    ),
    "usage-syntax-only": Message("structure alone", "la structure seulement"),
    "usage-lang": Message(
        "language of messages (default en)", "langue des messages (en par défaut)"
    ),
    "usage-set-one": Message(
        "value that the script's first assignment to NAME gives instead of its own",
        "valeur que donne la première affectation de NAME dans le script, au lieu de la sienne",
    ),
    "usage-set-many": Message(
        "values of NAME: a,b,c or first:last:step; several --set make all combinations",
        "valeurs de NAME : a,b,c ou premier:dernier:pas ; plusieurs --set font toutes les "
        "combinaisons",
    ),
    "usage-interactive": Message(
        "keep the session after it", "garde la session ouverte après le script"
    ),
    "usage-motions": Message(
        "run each file of DIR; its path is MOTION",
        "exécute pour chaque fichier de DIR, dont le chemin est MOTION",
    ),
    "usage-out": Message(
        "output folder (default results/<case>)",
        "répertoire des résultats (results/<cas> par défaut)",
    ),
    "usage-out-sweep": Message(
        "output folder (default results/<case>_sweep)",
        "répertoire des résultats (results/<cas>_sweep par défaut)",
    ),
    "usage-jobs": Message("processes (default: one a core)", "processus (par défaut un par cœur)"),
    "usage-together": Message(
        "most runs of a process whose steps are taken together (default 8; 1: none)",
        "nombre maximal de calculs d'un processus dont les pas se font ensemble (8 par défaut ; "
        "1 : aucun)",
    ),
    "usage-scheduler": Message("address of a Dask scheduler", "adresse d'un ordonnanceur Dask"),
    "usage-allow": Message(
        "further folder to read and write", "autre répertoire où lire et écrire"
    ),
    "usage-allow-geo": Message(
        "let Gmsh run .geo files where the system cannot guard it",
        "laisser Gmsh exécuter des fichiers .geo où le système ne peut l'enfermer",
    ),
    "usage-verbose": Message(
        "say by which method motions are calculated",
        "dit par quelle méthode les mouvements sont calculés",
    ),
    "usage-resume": Message(
        "go on where a run of the same deck was ended, from what 'REPRISE' of DYNAMIC or PASAPAS "
        "kept in the output folder",
        "continuer où un calcul du même jeu a été arrêté, depuis ce que 'REPRISE' de DYNAMIC ou "
        "de PASAPAS a gardé dans le répertoire des résultats",
    ),
    "nothing-to-resume": Message(
        "'{folder}' holds no checkpoint: the run begins at its start",
        "'{folder}' ne contient pas de point de reprise : le calcul part de son début",
        "REPRISE of DYNAMIC or PASAPAS keeps a calculation on its way",
        "REPRISE de DYNAMIC ou de PASAPAS garde un calcul en chemin",
        severity="warning",
    ),
    "usage-quiet": Message(
        "no closing line about files and warnings",
        "sans la ligne finale sur les fichiers et les avertissements",
    ),
    "usage-debug": Message("show Python's traceback too", "montre aussi la trace de Python"),
    "usage-max-recursion": Message(
        "procedure calls in depth (default 200)",
        "profondeur des appels de procédures (200 par défaut)",
    ),
    "usage-max-statements": Message(
        "stop after so many statements", "s'arrête après ce nombre d'instructions"
    ),
    "usage-max-memory": Message("stop past so much memory", "s'arrête au-delà de cette mémoire"),
    "usage-petsc": Message(
        "what starts PETSc for OPTI 'SOLVEUR' 'PETSC': 'mpirun -n 4 /usr/bin/python3'",
        "ce qui lance PETSc pour OPTI 'SOLVEUR' 'PETSC' : 'mpirun -n 4 /usr/bin/python3'",
    ),
    "usage-error": Message("{program}: error: {problem}", "{program} : erreur : {problem}"),
    "usage-no-file": Message(
        "run needs a file, or - for standard input",
        "run demande un fichier, ou - pour l'entrée standard",
    ),
    "usage-required": Message(
        "the following arguments are required: {names}",
        "il manque les arguments suivants : {names}",
    ),
    "usage-unrecognized": Message(
        "unrecognized arguments: {names}", "arguments inconnus : {names}"
    ),
    "usage-invalid-choice": Message(
        "argument {name}: invalid choice: {value} (choose from {choices})",
        "argument {name} : choix invalide {value} (à choisir parmi {choices})",
    ),
    "usage-invalid-int": Message(
        "argument {name}: invalid int value: {value}",
        "argument {name} : {value} n'est pas un entier",
    ),
    "usage-expected-one": Message(
        "argument {name}: expected one argument", "argument {name} : il y faut une valeur"
    ),
    "usage-ignored": Message(
        "argument {name}: ignored explicit argument {value}",
        "argument {name} : la valeur {value} n'a pas de sens ici",
    ),
    "usage-ambiguous": Message(
        "ambiguous option: {name} could match {choices}",
        "option ambiguë : {name} peut être {choices}",
    ),
    "fix-quote": Message("close the quote", "fermer l'apostrophe"),
    "fix-semicolon": Message("end the statement with ;", "terminer l'instruction par ;"),
    "fix-parenthesis": Message("close the parenthesis", "fermer la parenthèse"),
    "fix-remove": Message("take it out", "l'enlever"),
    "fix-replace": Message("replace by {near}", "remplacer par {near}"),
    "name-variable": Message("first given at line {line}", "donné d'abord à la ligne {line}"),
    "name-parameter": Message("argument, line {line}", "argument, ligne {line}"),
    "name-procedure": Message("procedure of line {line}", "procédure de la ligne {line}"),
    "name-loop": Message("loop of line {line}", "boucle de la ligne {line}"),
    "formatted": Message("{file}: laid out", "{file} : mis en forme"),
    "would-format": Message("{file} would be laid out", "{file} serait mis en forme"),
    "rename-taken": Message(
        "{name} is no name, or names something else",
        "{name} n'est pas un nom, ou désigne autre chose",
    ),
    "lsp-extra": Message(
        "the language server needs pygls: pip install 'ssilang[editor]'",
        "le serveur de langage demande pygls : pip install 'ssilang[editor]'",
    ),
    "usage-view": Message(
        "show results, a mesh or a picture in a window, or draw it to a file",
        "montre des résultats, un maillage ou une image dans une fenêtre, ou les dessine",
    ),
    "usage-view-file": Message(
        "file (vtkhdf, pvd, vtu, msh, med, png ...) or folder of results",
        "fichier (vtkhdf, pvd, vtu, msh, med, png ...) ou dossier de résultats",
    ),
    "usage-view-output": Message(
        "write a picture (png, jpg) or all instants (gif) instead of opening a window",
        "écrit une image (png, jpg) ou tous les instants (gif) au lieu d'ouvrir une fenêtre",
    ),
    "usage-view-field": Message(
        "field that colours, and its component (the displacement, or the first field)",
        "champ qui colore, et sa composante (le déplacement, ou le premier champ)",
    ),
    "usage-view-step": Message("instant, from 1 (the last)", "instant, à partir de 1 (le dernier)"),
    "usage-view-scale": Message(
        "displacements so many times as large (a scale that shows them)",
        "déplacements multipliés par ce nombre (une échelle qui les montre)",
    ),
    "usage-lsp": Message(
        "language server for editors, over standard input and output",
        "serveur de langage pour les éditeurs, par l'entrée et la sortie standard",
    ),
    "usage-format": Message("lay out scripts", "met des scripts en forme"),
    "usage-format-files": Message(
        "scripts; - reads standard input and prints", "scripts ; - lit l'entrée standard et affiche"
    ),
    "usage-format-check": Message(
        "write nothing; exit code 1 if a script would change",
        "n'écrit rien ; code de sortie 1 si un script changerait",
    ),
    "usage-format-diff": Message(
        "print the changes instead of making them",
        "affiche les changements au lieu de les faire",
    ),
    "usage-check-format": Message(
        "how problems are printed: text, json, or github (notes beside the lines of a change)",
        "forme des problèmes : text, json, ou github (notes à côté des lignes d'un changement)",
    ),
    "no-starter": Message(
        "there is no starter '{word}'",
        "il n'y a pas de modèle '{word}'",
        "{near:?did you mean {near}?|there are {known:and}}",
        "{near:?vouliez-vous dire {near} ?|il y a {known:and}}",
    ),
    "starter-there": Message(
        "{path} is there already",
        "{path} existe déjà",
        "give another name: ssilang new NAME FILE",
        "donnez un autre nom : ssilang new NOM FICHIER",
    ),
    "starter-written": Message(
        "{path}: run it with   ssilang {path}", "{path} : à exécuter par   ssilang {path}"
    ),
    "usage-new": Message(
        "write a commented deck to begin with", "écrit un jeu de données commenté pour commencer"
    ),
    "usage-new-name": Message("which one; none lists all", "lequel ; sans nom, la liste"),
    "usage-new-file": Message("file to write (NAME.ssi here)", "fichier à écrire (NOM.ssi, ici)"),
    "usage-completion": Message(
        "print the completion of a shell", "affiche la complétion d'un interpréteur de commandes"
    ),
    "usage-shell": Message(
        "bash, zsh, fish; words: what help knows", "bash, zsh, fish ; words : ce que l'aide connaît"
    ),
}
