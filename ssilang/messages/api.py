"""What ssilang/api refuses."""

from ssilang.messages.message import Message

_NEAR = "{near:?did you mean {near}?|{known:?there are {known:and}|there is nothing}}"
_NEAR_FR = "{near:?vouliez-vous dire {near} ?|{known:?il y a {known:and}|il n'y a rien}}"

MESSAGES: dict[str, Message] = {
    "library-missing": Message(
        "this needs {name}: pip install {line}",
        "ceci demande {name} : pip install {line}",
    ),
    "no-report": Message(
        "the run has left no report",
        "le calcul n'a pas laissé de rapport",
        "ssilang.run(..., report=True)",
        "ssilang.run(..., report=True)",
    ),
    "report-without-folder": Message(
        "report=True of a sweep needs a folder: nothing would stay of it",
        "report=True d'un balayage demande un dossier : rien n'en resterait",
        "ssilang.sweep(..., out='DIR', report=True)",
        "ssilang.sweep(..., out='DIR', report=True)",
    ),
    "no-such-name": Message(
        "the script has no {name}", "le jeu de données n'a pas de {name}", _NEAR, _NEAR_FR
    ),
    "no-such-index": Message(
        "the table has no index {index}", "la table n'a pas d'indice {index}", _NEAR, _NEAR_FR
    ),
    "no-such-component": Message(
        "the field has no component '{name}'",
        "le champ n'a pas de composante '{name}'",
        "{near:?did you mean '{near}'?|{known:?there are {known:and}|there is nothing}}",
        "{near:?vouliez-vous dire '{near}' ?|{known:?il y a {known:and}|il n'y a rien}}",
    ),
    "no-such-figure": Message(
        "the script reports no figure '{name}'",
        "le jeu de données n'a pas de résultat '{name}'",
        _NEAR,
        _NEAR_FR,
    ),
    "no-such-zone": Message(
        "the field has no zone {zone}: it has {count} {count:zone|zones}, counted from 1",
        "le champ n'a pas de zone {zone} : il a {count} {count:zone|zones}, comptées à partir de 1",
    ),
    "which-zone": Message(
        "several zones have the component '{component}': {zones}",
        "plusieurs zones ont la composante '{component}' : {zones}",
        "values(component, zone) gives those of one",
        "values(composante, zone) donne celles d'une zone",
    ),
    "which-curve": Message(
        "the evolution has {count} {count:curve|curves}, not one",
        "l'évolution a {count} {count:courbe|courbes}, et non une seule",
        "evolution[0] is the first, frame() gives all of them",
        "evolution[0] est la première, frame() les donne toutes",
    ),
    "no-such-object": Message(
        "a script takes no {kind} of Python",
        "un jeu de données ne prend pas de {kind} de Python",
        "it takes numbers, words, True and False, lists of them, a pandas Series, what a run gave",
        "il prend des nombres, des mots, True et False, leurs listes, une Series de pandas, ce "
        "qu'un calcul a donné",
    ),
    "other-run": Message(
        "{name} is a {kind} of another run: its nodes are not those of this one",
        "{name} est un {kind} d'un autre calcul : ses noeuds ne sont pas ceux de celui-ci",
        "write it to a file and read it in the script, or make it there",
        "écrivez-le dans un fichier que le jeu de données lira, ou faites-le dans celui-ci",
    ),
    "no-results": Message(
        "this is no table of results of DYNAMIC or PASAPAS",
        "ceci n'est pas une table de résultats de DYNAMIC ou de PASAPAS",
    ),
    "no-results-here": Message(
        "the script has no table of results of DYNAMIC or PASAPAS under a name of its own",
        "le jeu de données n'a pas de table de résultats de DYNAMIC ou de PASAPAS qui ait un nom",
        "give the table: history(..., table=result['T']['RESULTS'])",
        "donnez la table : history(..., table=result['T']['RESULTATS'])",
    ),
    "which-results": Message(
        "the script has several tables of results: {names:and}",
        "le jeu de données a plusieurs tables de résultats : {names:and}",
        "say which: table='NAME'",
        "dites laquelle : table='NOM'",
    ),
    "no-such-result": Message(
        "the table of results has no '{word}'",
        "la table de résultats n'a pas de '{word}'",
        "{near:?did you mean '{near}'?|it has {known:and}}",
        "{near:?vouliez-vous dire '{near}' ?|elle a {known:and}}",
    ),
    "no-point": Message(
        "a {kind} is no point",
        "un {kind} n'est pas un point",
        "a point is its name, its node's number, or its coordinates",
        "un point est son nom, le numéro de son noeud, ou ses coordonnées",
    ),
    "no-such-node": Message(
        "there is no node {number}: they are counted from 1 to {count}",
        "il n'y a pas de noeud {number} : ils sont numérotés de 1 à {count}",
    ),
    "no-node-there": Message(
        "no node stands there; the nearest is {nearest}, at a distance of {distance:.3g}",
        "aucun noeud n'est à cet endroit ; le plus proche est {nearest}, à une distance de "
        "{distance:.3g}",
    ),
    "several-nodes": Message(
        "several nodes stand there: {nodes:and}",
        "plusieurs noeuds sont à cet endroit : {nodes:and}",
        "give the number of the one that is meant, or the name of its point",
        "donnez le numéro de celui que vous voulez, ou le nom de son point",
    ),
    "no-such-dimension": Message(
        "there are 2 and 3 dimensions, not {dimension}",
        "il y a 2 ou 3 dimensions, pas {dimension}",
    ),
    "no-block": Message(
        "{corner} and {opposite} are no corners of a block with cells of size {size}",
        "{corner} et {opposite} ne sont pas les coins d'un bloc à mailles de taille {size}",
        "two opposite corners that differ along each axis, and a positive size",
        "deux coins opposés, différents selon chaque axe, et une taille positive",
    ),
    "no-such-side": Message(
        "a part has no side '{side}'",
        "une partie n'a pas de côté '{side}'",
        "{near:?did you mean '{near}'?|there are {known:and}}",
        "{near:?vouliez-vous dire '{near}' ?|il y a {known:and}}",
    ),
    "no-such-material": Message(
        "the law takes no '{name}'",
        "la loi ne prend pas de '{name}'",
        "{near:?did you mean '{near}'?|it takes {known:and}}",
        "{near:?vouliez-vous dire '{near}' ?|elle prend {known:and}}",
    ),
    "material-missing": Message(
        "the law needs {names:and}",
        "la loi demande {names:and}",
    ),
    "no-such-unknown": Message(
        "there is no unknown '{name}' here: there are {known:and}",
        "il n'y a pas d'inconnue '{name}' ici : il y a {known:and}",
    ),
    "no-such-start": Message(
        "a run starts at 'rest' under the weight or 'unloaded', not '{start}'",
        "un calcul part au repos sous le poids ('rest') ou déchargé ('unloaded'), pas '{start}'",
    ),
    "no-such-word": Message(
        "a motion has {known:and}, not '{word}'",
        "un mouvement a {known:and}, pas '{word}'",
    ),
    "joint-of-another": Message(
        "the joint is of another builder",
        "le joint est d'un autre assemblage",
    ),
    "no-script": Message(
        "a {kind} is no script",
        "un {kind} n'est pas un jeu de données",
        "give the path of a file, or its text: statements that end in ;",
        "donnez le chemin d'un fichier, ou son texte : des instructions terminées par ;",
    ),
    "sweep-of-a-file": Message(
        "a sweep runs a file: each run reads it in a process of its own",
        "un balayage exécute un fichier : chaque calcul le lit dans son propre processus",
        "write the text to a file first",
        "écrivez d'abord le texte dans un fichier",
    ),
    "no-value-of-sweep": Message(
        "{name} takes numbers, words, True or False in a sweep, not {kind}",
        "{name} prend des nombres, des mots, True ou False dans un balayage, pas {kind}",
    ),
    "runs-failed": Message(
        "{count} of {total} runs failed; the first: {error}",
        "{count} {count:calcul|calculs} sur {total} en échec ; le premier : {error}",
    ),
}
