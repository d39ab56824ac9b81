"""What ssilang/operators/session refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "local-axes-kept": Message(
        "the local axes of characteristics are not updated",
        "les axes locaux des caractéristiques ne sont pas mis à jour",
        "give new ones with MATE",
        "donnez-en de nouveaux par MATE",
    ),
    "no-procedure-runs": Message(
        "ARGU reads the arguments of a procedure, none is running",
        "ARGU lit les arguments d'une procédure, aucune n'est en cours",
    ),
    "nothing-empty-of-type": Message(
        "no empty '{kind}' can be made",
        "aucun '{kind}' vide ne se fabrique",
        "{makers:words}",
        "{makers:words}",
    ),
    "no-such-cell": Message(
        "'{sub}' is no type of cell",
        "'{sub}' n'est pas un type d'élément",
        "{cell_types:words}",
        "{cell_types:words}",
    ),
    "never-empty": Message(
        "a {found} is never empty",
        "un objet {found} n'est jamais vide",
    ),
    "what-of-the-model": Message(
        "what is looked for in the model?",
        "que cherche-t-on dans le modèle ?",
        "FORM CONS ELEM MATE",
        "FORM CONS ELEM MATE",
    ),
    "name-is-a-word": Message(
        "a name is a word, or a variable that holds one",
        "un nom est un mot, ou une variable qui en contient un",
    ),
    "empty-name": Message(
        "the name is empty",
        "le nom est vide",
    ),
    "no-object": Message(
        "no object is there",
        "il n'y a pas d'objet",
        "OBJ1%METHODE NOM1 METH1 ;",
        "OBJ1%METHODE NOM1 METH1 ;",
    ),
    "nothing-to-inherit": Message(
        "the object to inherit from is missing",
        "l'objet dont hériter manque",
        "OBJ1%HERITE OBJ2 ;",
        "OBJ1%HERITE OBJ2 ;",
    ),
    "no-such-procedure": Message(
        "no procedure is called {name}",
        "aucune procédure ne s'appelle {name}",
        "DEBP {name} TAB1*TABLE ; ... FINP ;",
        "DEBP {name} TAB1*TABLE ; ... FINP ;",
    ),
}
