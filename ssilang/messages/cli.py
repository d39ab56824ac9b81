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
        "there is no file in {folder}",
        "il n'y a pas de fichier dans {folder}",
    ),
    "set-twice": Message(
        "{name} is set twice",
        "{name} est donné deux fois",
    ),
    "sweep-writes-parquet-pip": Message(
        "a sweep writes Parquet: pip install 'ssilang[sweep]'",
        "un balayage écrit du Parquet : pip install 'ssilang[sweep]'",
    ),
    "cluster-needs-dask-distributed": Message(
        "a cluster needs dask.distributed: pip install 'ssilang[cluster]'",
        "un cluster demande dask.distributed : pip install 'ssilang[cluster]'",
    ),
    "several-values": Message(
        "{text} gives {name} several values: that is a sweep",
        "{text} donne à {name} plusieurs valeurs : c'est un balayage",
    ),
    "range-values": Message(
        "the range {text} has {count} {count:value|values}",
        "l'intervalle {text} a {count} {count:valeur|valeurs}",
    ),
    "runs-done": Message(
        "{done} of {total} runs are done already",
        "{done} calculs sur {total} sont déjà faits",
    ),
    "run-failed": Message(
        "run {number} failed: {error} (runs/{folder})",
        "le calcul {number} a échoué : {error} (runs/{folder})",
    ),
    "swept": Message(
        "{runs} {runs:run|runs}, {failed} failed; {table}, {pictures} {pictures:picture|pictures}",
        "{runs} {runs:calcul|calculs}, {failed} en échec ; {table}, {pictures} "
        "{pictures:image|images}",
    ),
    "no-working-folder": Message(
        "the working folder was removed",
        "le dossier de travail a été supprimé",
        "go to a folder that is there (cd)",
        "allez dans un dossier qui existe (cd)",
    ),
    "compiled-code-refused": Message(
        "others could have put code into {folder}: none is read from there or kept, this run "
        "compiles anew",
        "d'autres ont pu mettre du code dans {folder} : rien n'y est lu ni conservé, ce calcul "
        "compile à nouveau",
        "{fault} must belong to you, be no link, and not let others write (chmod 700)",
        "{fault} doit vous appartenir, ne pas être un lien et ne pas laisser écrire les autres "
        "(chmod 700)",
    ),
    "files-written": Message(
        "{count} {count:file|files} in {folder}, {warnings} {warnings:warning|warnings}"
        "{energy:?, energy within {energy} %}{amount:? ({amount})}",
        "{count} {count:fichier|fichiers} dans {folder}, {warnings} "
        "{warnings:avertissement|avertissements}{energy:?, énergie à {energy} % près}"
        "{amount:? ({amount})}",
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
}
