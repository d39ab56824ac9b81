"""What the interactive session says, in two languages."""

from __future__ import annotations

TEXTS: dict[str, dict[str, str]] = {
    "welcome": {
        "en": "ssilang {version}. Statements end with ;   INFO NAME ; shows help, %help the "
        "commands, FIN ; leaves.",
        "fr": "ssilang {version}. Une instruction finit par ;   INFO NOM ; montre l'aide, %help "
        "les commandes, FIN ; fait sortir.",
    },
    "commands": {
        "en": """%help            this list
%vars            the objects of the session
%save FILE       write the statements that ran to a script
%run FILE        run a script in this session
%quit            leave (also FIN ; or Ctrl-D)
Ctrl-C stops what runs, or forgets what is being typed; Tab completes.""",
        "fr": """%help            cette liste
%vars            les objets de la session
%save FICHIER    écrire les instructions exécutées dans un script
%run FICHIER     exécuter un script dans cette session
%quit            sortir (ou FIN ; ou Ctrl-D)
Ctrl-C arrête le calcul en cours, ou oublie ce qui est tapé ; Tab complète.""",
    },
    "unknown": {
        "en": "there is no command {name}; %help lists them",
        "fr": "il n'y a pas de commande {name} ; %help en donne la liste",
    },
    "saved": {"en": "{count} lines written to {path}", "fr": "{count} lignes écrites dans {path}"},
    "file": {"en": "{name} needs a file's name", "fr": "{name} demande un nom de fichier"},
    "interrupted": {
        "en": "interrupted; the session goes on",
        "fr": "interrompu ; la session continue",
    },
}
