"""What ssilang/operators/session refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "no-procedure-runs": Message(
        "ARGU reads the arguments of a procedure, none is running",
        "ARGU lit les arguments d'une procédure, aucune n'est en cours",
    ),
    "all-assistants": Message(
        "ASSI TOUS: the same phrase for all objects of a table is not available",
        "ASSI TOUS : la même phrase pour tous les objets d'une table n'est pas disponible",
        "write a loop over the table (REPE)",
        "écrivez une boucle sur la table (REPE)",
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
    "dimension": Message(
        "the space has 1, 2 or 3 dimensions, not {n}",
        "l'espace a 1, 2 ou 3 dimensions, pas {n}",
    ),
    "mesh-size": Message(
        "a mesh size is positive, this one is {size:g}",
        "une taille de maille est positive, pas {size:g}",
    ),
    "unknowns-in-pairs": Message(
        "{n_primal} primal and {n_dual} dual unknowns are named",
        "{n_primal} inconnues primales et {n_dual} duales sont nommées",
    ),
    "no-option": Message(
        "no option is named",
        "aucune option n'est nommée",
        "for example OPTI DIME 2 ELEM QUA4 ;",
        "par exemple OPTI DIME 2 ELEM QUA4 ;",
    ),
    "mode-and-dimension": Message(
        "mode {mode} needs dimension {dimension}, DIME is {present}",
        "le mode {mode} demande la dimension {dimension}, DIME vaut {present}",
        "set DIME {dimension}",
        "donnez DIME {dimension}",
    ),
    "option-not-set": Message(
        "option {word} was not set",
        "l'option {word} n'a pas été donnée",
    ),
    "no-value-of-option": Message(
        "'{said}' is no value of {option}",
        "'{said}' n'est pas une valeur pour {option}",
        "{near:?did you mean {near}? }it takes {values:words}{told}",
        "{near:?vouliez-vous dire {near} ? }valeurs possibles : {values:words}{told}",
    ),
    "tolerance-of-solver": Message(
        "multigrid cannot end at a residual of {tolerance:g} of the second member",
        "le multigrille ne peut s'arrêter à un résidu de {tolerance:g} du second membre",
        "between {finest:g} and {coarsest:g}; without a number 1e-12",
        "entre {finest:g} et {coarsest:g} ; sans nombre 1e-12",
    ),
    "unknown-option": Message(
        "'{said}' is no option",
        "'{said}' n'est pas une option",
        "{near:?did you mean {near}?|options are {options:words}}{told}",
        "{near:?vouliez-vous dire {near} ?|les options sont {options:words}}{told}",
    ),
    "hidden-option": Message(
        "{name} is a variable here, of type {found}, and hides the option of that name",
        "{name} est ici une variable, de type {found}, et cache l'option de ce nom",
        "write '{name}' {said}, or give the variable another name",
        "écrivez '{name}' {said}, ou donnez un autre nom à la variable",
    ),
    "no-help": Message(
        "there is no help about {said}",
        "il n'y a pas d'aide sur {said}",
        "{near:?did you mean {near}?|`ssilang help` lists what there is}",
        "{near:?vouliez-vous dire {near} ?|`ssilang help` dit ce qu'il y a}",
    ),
    # ---- what is printed
    "clocks": Message(
        "elapsed {wall:.3f} s, processor {cpu:.3f} s",
        "temps écoulé {wall:.3f} s, processeur {cpu:.3f} s",
    ),
    "time-left": Message("{seconds:.0f} s left", "reste {seconds:.0f} s"),
}
