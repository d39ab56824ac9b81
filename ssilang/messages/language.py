"""What the language refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    # ---- files and limits
    "missing-file": Message(
        "the file {path} cannot be read: {reason:?{reason}|no such file}",
        "le fichier {path} ne peut pas être lu : {reason:?{reason}|il n'existe pas}",
    ),
    "other-case": Message(
        "{path} is read: an earlier case left it in its own output folder",
        "{path} est lu : un cas précédent l'a laissé dans son dossier de sortie",
        "copy the file beside the script if it belongs to it",
        "copiez le fichier à côté du jeu de données s'il lui appartient",
        severity="warning",
    ),
    "forbidden-path": Message(
        "the file {path} is outside the script's folder and the output folder",
        "le fichier {path} est hors du dossier du jeu de données et du dossier de sortie",
        "run with --allow {folder} to permit it",
        "lancez avec --allow {folder} pour l'autoriser",
    ),
    "statement-limit": Message(
        "more than {limit} statements were run", "plus de {limit} instructions exécutées"
    ),
    "recursion": Message(
        "procedures call each other more than {limit} levels deep",
        "les procédures s'appellent sur plus de {limit} niveaux",
        "look for a recursive call whose end test is never met",
        "cherchez un appel récursif dont le test d'arrêt n'est jamais vrai",
    ),
    "cannot-print": Message(
        "what is printed cannot be written: {reason}",
        "ce qui est imprimé ne peut être écrit : {reason}",
    ),
    "memory": Message(
        "{operator} needs more memory than there is", "{operator} : mémoire insuffisante"
    ),
    "internal": Message(
        "{operator} failed in a way it should not ({kind}: {reason})",
        "{operator} a échoué de façon inattendue ({kind} : {reason})",
        "this is a defect of ssilang; run again with --debug and report what it prints",
        "c'est un défaut de ssilang ; relancez avec --debug et signalez le résultat",
    ),
    "nesting": Message(
        "parentheses, blocks or procedures are nested too deep",
        "parenthèses, blocs ou procédures trop profondément emboîtés",
        "cut the statement in several, with names for the parts",
        "coupez l'instruction en plusieurs, en nommant les parties",
    ),
    "endless-text": Message(
        "the TEXTE {name} leads back to itself",
        "le TEXTE {name} renvoie à lui-même",
    ),
    "long-integer": Message(
        "an ENTIER of {digits} digits is too large",
        "un ENTIER de {digits} chiffres est trop grand",
        "write it as a FLOTTANT, with a dot or an exponent",
        "écrivez-le comme un FLOTTANT, avec un point ou un exposant",
    ),
    "long-real": Message(
        "{text} is beyond 1.8E308, the largest FLOTTANT",
        "{text} dépasse 1.8E308, le plus grand FLOTTANT",
    ),
    # ---- syntax
    "syntax": Message("unexpected {found!r}", "{found!r} inattendu"),
    "unclosed-string": Message(
        "this quote is never closed",
        "cette apostrophe n'est jamais fermée",
        "a quote inside a string is written twice: 'l''axe'",
        "une apostrophe dans un texte se double : 'l''axe'",
    ),
    "double-quotes": Message(
        'a text stands between apostrophes, not between "',
        'un texte se met entre apostrophes, pas entre "',
        "write 'text'; an apostrophe inside is written twice: 'l''axe'",
        "écrivez 'texte' ; une apostrophe dans le texte se double : 'l''axe'",
    ),
    "decimal-comma": Message(
        "{text} is two numbers, {first} and {second}: a comma separates",
        "{text} est deux nombres, {first} et {second} : une virgule sépare",
        "the decimal sign is a dot: {first}.{second}; two numbers are written {first} {second}",
        "le signe décimal est le point : {first}.{second} ; deux nombres s'écrivent "
        "{first} {second}",
    ),
    "statement-goes-on": Message(
        "{word} begins line {line} but the statement of line {first} goes on there: is the ; "
        "before it missing?",
        "{word} commence la ligne {line} mais l'instruction de la ligne {first} s'y poursuit : "
        "manque-t-il le ; qui précède ?",
    ),
    "early-quote": Message(
        "this apostrophe ends the text {text} and what follows is no text any more",
        "cette apostrophe ferme le texte {text} et la suite n'est plus du texte",
        "an apostrophe inside a text is written twice: 'l''axe'",
        "une apostrophe dans un texte se double : 'l''axe'",
    ),
    "unclosed-paren": Message(
        "this parenthesis is never closed", "cette parenthèse n'est jamais fermée", number=1
    ),
    "extra-paren": Message(
        "this closing parenthesis has no opening one",
        "cette parenthèse fermante n'a pas d'ouvrante",
        number=2,
    ),
    "missing-semicolon": Message(
        "the last statement does not end with ;",
        "la dernière instruction ne finit pas par ;",
        "{comment_hint}",
        "{comment_hint}",
    ),
    "second-equal": Message(
        "a second = in one statement",
        "un second = dans une instruction",
        "is the ; of the statement before missing? A comparison is written EGA",
        "manque-t-il le ; de l'instruction précédente ? Une comparaison s'écrit EGA",
    ),
    "no-target": Message(
        "there is no name in front of =",
        "il n'y a pas de nom devant =",
        "write NAME = ... ;",
        "écrivez NOM = ... ;",
    ),
    "equal-comparison": Message(
        "= gives a value to a name, it does not compare",
        "= donne une valeur à un nom, il ne compare pas",
        "comparisons are written A EGA B, A NEG B, A > B, A < B, A >EG B, A <EG B",
        "une comparaison s'écrit A EGA B, A NEG B, A > B, A < B, A >EG B, A <EG B",
    ),
    "nothing-behind": Message(
        "something is missing behind {sign}",
        "il manque quelque chose derrière {sign}",
        "a table is read by TABLE . INDEX, an attribute by OBJECT%NAME",
        "une table se lit par TABLE . INDICE, un attribut par OBJET%NOM",
    ),
    "crossed-blocks": Message(
        "FIN {name} comes while {inside} of line {line} is still open",
        "FIN {name} arrive alors que {inside} de la ligne {line} est encore ouvert",
        "blocks nest: write its {missing} before this FIN",
        "les blocs s'emboîtent : écrivez son {missing} avant ce FIN",
    ),
    "second-sinon": Message(
        "a second SINON for the SI of line {line}",
        "un second SINON pour le SI de la ligne {line}",
        "there is no else-if: write SI ... ; ... FINSI ; inside of the SINON",
        "il n'y a pas de sinon-si : écrivez SI ... ; ... FINSI ; dans le SINON",
    ),
    "sinon-condition": Message(
        "SINON takes no condition",
        "SINON ne prend pas de condition",
        "there is no else-if: write SI ... ; ... FINSI ; inside of the SINON",
        "il n'y a pas de sinon-si : écrivez SI ... ; ... FINSI ; dans le SINON",
    ),
    "unclosed-block": Message(
        "{word} opens a block that is never closed: {missing} is missing",
        "{word} ouvre un bloc qui n'est jamais fermé : il manque {missing}",
    ),
    "stray-block-end": Message(
        "{word} has no open {opener} to close{inside_text}",
        "{word} ne ferme aucun {opener} ouvert{inside_text}",
    ),
    "wrong-loop-name": Message(
        "FIN closes {found}, but the innermost open loop is {expected}",
        "FIN ferme {found}, mais la boucle ouverte la plus intérieure est {expected}",
        number=154,
    ),
    "loop-name": Message(
        "REPE needs a name for its loop",
        "REPE demande un nom de boucle",
        "write REPE BOUCLE 10 ; ... FIN BOUCLE ;",
        "écrivez REPE BOUCLE 10 ; ... FIN BOUCLE ;",
    ),
    "procedure-name": Message(
        "DEBPROC needs a name",
        "DEBPROC demande un nom",
        "write DEBP MYPROC A*ENTIER B/FLOTTANT ; ... FINP C ;",
        "écrivez DEBP MAPROC A*ENTIER B/FLOTTANT ; ... FINP C ;",
    ),
    "parameter": Message(
        "a procedure's argument is written NAME*TYPE (mandatory) or NAME/TYPE (optional)",
        "un argument de procédure s'écrit NOM*TYPE (obligatoire) ou NOM/TYPE (facultatif)",
    ),
    # ---- phrases
    "unknown-operator": Message(
        "{name} is neither an operator, nor a procedure, nor an object that has a value",
        "{name} n'est ni un opérateur, ni une procédure, ni un objet qui a une valeur",
        "{near_hint}",
        "{near_hint}",
    ),
    "set-later": Message(
        "{name} has no value here: line {line} gives it one",
        "{name} n'a pas de valeur ici : c'est la ligne {line} qui lui en donne une",
        "statements run from top to bottom: move that line before this one",
        "les instructions s'exécutent de haut en bas : mettez cette ligne avant celle-ci",
    ),
    "type-for-operator": Message(
        "{word} is a type, and no operator",
        "{word} est un type, et non un opérateur",
        "{maker} makes such a list",
        "{maker} fait une telle liste",
    ),
    "unread-operator": Message(
        "the phrase ends before {name}, which is not run{before_text}",
        "la phrase finit avant {name}, qui n'est pas exécuté{before_text}",
        "put what stands before it in parentheses, or write {name} in front of its operands",
        "mettez ce qui précède entre parenthèses, ou écrivez {name} devant ses opérandes",
    ),
    "hidden-operator": Message(
        "{name} is an object of yours here (of type {found}), which hides the operator {name}",
        "{name} est ici un de vos objets (de type {found}), qui cache l'opérateur {name}",
        "give the object another name, or write the operator between quotes: '{name}'",
        "donnez un autre nom à l'objet, ou écrivez l'opérateur entre apostrophes : '{name}'",
    ),
    "glued-sign": Message(
        "{number} is a number of its own here, not a sum",
        "{number} est ici un nombre à part, pas une somme",
        "a sign glued to its number and behind a blank belongs to the number: write {sign} {rest}",
        "un signe collé à son nombre et après un blanc fait partie du nombre : "
        "écrivez {sign} {rest}",
        number=11,
    ),
    "excess": Message(
        "nothing reads this {found}{named}",
        "rien ne lit cet objet {found}{named}",
        "{excess_hint}",
        "{excess_hint}",
        number=11,
    ),
    "results-in-excess": Message(
        "{caller} gives several results here: {types:words}",
        "{caller} donne ici plusieurs résultats : {types:words}",
        "give each a name in front of =, `A B ... = {caller} ... ;`, then use the one that is "
        "wanted",
        "donnez un nom à chacun devant =, `A B ... = {caller} ... ;`, puis servez-vous de celui "
        "qu'il faut",
        number=11,
    ),
    "no-result": Message(
        "there is no result{wanted_text} for the name {name}",
        "il n'y a pas de résultat{wanted_text} pour le nom {name}",
        "{no_result_hint}",
        "{no_result_hint}",
        number=37,
    ),
    "unended-statement": Message(
        "the ; that ends this statement is missing: {name} = on line {line} begins another",
        "il manque le ; qui finit cette instruction : {name} = à la ligne {line} en commence une "
        "autre",
        "{comment_hint}",
        "{comment_hint}",
        number=37,
    ),
    "target": Message(
        "a result can be given to a name, to TABLE . INDEX or to %ATTRIBUTE only",
        "un résultat se donne à un nom, à TABLE . INDICE ou à %ATTRIBUT seulement",
        "{comment_hint}",
        "{comment_hint}",
    ),
    "condition": Message(
        "SI needs one LOGIQUE, found {found}{word:? ('{word}')}",
        "SI demande un LOGIQUE, trouvé {found}{word:? ('{word}')}",
        "{word:?write {word} alone: in quotes, or behind MOT, it is a word|comparisons are written "
        "> < >EG <EG EGA NEG, and phrases run from left to right}",
        "{word:?écrivez {word} seul : entre apostrophes, ou derrière MOT, c'est un mot|les "
        "comparaisons s'écrivent > < >EG <EG EGA NEG, et les phrases vont de gauche à droite}",
    ),
    "loop-count": Message(
        "REPE needs an ENTIER as its number of turns, found {found}{word:? ('{word}')}",
        "REPE demande un ENTIER comme nombre de tours, trouvé {found}{word:? ('{word}')}",
        "{word:?write {word} alone: in quotes, or behind MOT, it is a word}",
        "{word:?écrivez {word} seul : entre apostrophes, ou derrière MOT, c'est un mot}",
    ),
    "index": Message(
        "the index of a table must be one object", "l'indice d'une table doit être un objet"
    ),
    "not-a-table": Message(
        "{name} is {a_found}, not a TABLE",
        "{name} est de type {found}, pas TABLE",
        "{not_a_table_hint}",
        "{not_a_table_hint}",
    ),
    "no-inner-table": Message(
        "the table has no index {index} yet",
        "la table n'a pas encore d'indice {index}",
        "make the inner table first: {path} = TABL ;",
        "créez d'abord la table intérieure : {path} = TABL ;",
        number=171,
    ),
    "no-index": Message(
        "the table has no index {index}",
        "la table n'a pas d'indice {index}",
        "{known_hint}",
        "{known_hint}",
        number=171,
    ),
    "not-an-object": Message(
        "% needs an OBJET on its left, found {found}",
        "% demande un OBJET à sa gauche, trouvé {found}",
    ),
    "no-attribute": Message(
        "the object {holder} has neither an attribute nor a method called {name}",
        "l'objet {holder} n'a ni attribut ni méthode de nom {name}",
        "its constructor gives it methods: %METHODE {name} PROCEDURE ;",
        "son constructeur lui donne des méthodes : %METHODE {name} PROCEDURE ;",
    ),
    "third-coordinate": Message(
        "a point needs three coordinates here (OPTI DIME 3), found two",
        "un point demande trois coordonnées ici (OPTI DIME 3), trouvé deux",
        number=37,
    ),
    # ---- operands
    "missing-argument": Message(
        "{operator} wanted {types}, found nothing",
        "{operator} attendait {types}, rien trouvé",
        "{syntax_hint}",
        "{syntax_hint}",
        number=37,
    ),
    "wrong-argument": Message(
        "{operator} wanted {types}, found {found_text}",
        "{operator} attendait {types}, trouvé {found_text}",
        "{caller_hint}{bare_hint}{point_hint}{word_hint}{keyword_hint}{syntax_hint}",
        "{caller_hint}{bare_hint}{point_hint}{word_hint}{keyword_hint}{syntax_hint}",
        number=37,
    ),
    "missing-keyword": Message(
        "{operator} wanted one of the words {words_text}{found_word}",
        "{operator} attendait l'un des mots {words_text}{found_word}",
        "{syntax_hint}",
        "{syntax_hint}",
    ),
    "form-condition": Message(
        "{operator} is written so {en} only",
        "{operator} ne s'écrit ainsi que {fr}",
        "{syntax_hint}",
        "{syntax_hint}",
    ),
    "missing-parameter": Message(
        "{procedure} wanted its argument {parameter} ({expected}), found {found}",
        "{procedure} attendait son argument {parameter} ({expected}), trouvé {found}",
        "it is declared as {heading}",
        "elle est déclarée {heading}",
        number=37,
    ),
    "two-operands": Message(
        "{operator} needs two operands",
        "{operator} demande deux opérandes",
        "there is no unary minus: write -1. * X",
        "il n'y a pas de moins unaire : écrivez -1. * X",
    ),
    "no-rule": Message(
        "{operator} does not go with {left} and {right}",
        "{operator} ne s'applique pas à {left} et {right}",
        "phrases run from left to right without precedence; put parentheses where you mean them",
        "les phrases vont de gauche à droite sans priorité ; mettez des parenthèses",
    ),
    "arithmetic": Message("{reason}", "{reason}"),
    "division-by-zero": Message("division by zero", "division par zéro"),
    "operand-not-finite": Message(
        "{operator} cannot calculate with {operand}, which has values that are no finite numbers",
        "{operator} ne peut calculer avec {operand}, qui a des valeurs qui ne sont pas des nombres "
        "finis",
        "VERI tells whether a value is a number; look where this one comes from",
        "VERI dit si une valeur est un nombre ; cherchez d'où vient celle-ci",
    ),
    "number-too-large": Message(
        "{operator} calculates with a number that is too large for it",
        "{operator} calcule avec un nombre trop grand pour lui",
        "integers that are no count stay below 2**63, reals below 1.8E308",
        "les entiers qui ne comptent rien restent sous 2**63, les réels sous 1.8E308",
    ),
    "too-large": Message("the result is too large", "le résultat est trop grand"),
    "no-value": Message("these values have no result", "ces valeurs n'ont pas de résultat"),
    # ---- entries of the tables of procedures
    "entry-missing": Message(
        "{procedure}: the entry {where} is missing",
        "{procedure} : l'indice {where} manque",
        "TAB1 . {where} = ... ;",
        "TAB1 . {where} = ... ;",
    ),
    "entry-type": Message(
        "{procedure}: {where} must be {kinds}, found {found}",
        "{procedure} : {where} doit être {kinds}, trouvé {found}",
        "{en:?{where}: {en}}{made:?\nmade by {made:or}}",
        "{fr:?{where} : {fr}}{made:?\nse fait par {made:or}}",
    ),
    "entry-value": Message(
        "{procedure}: {where} is '{given}'",
        "{procedure} : {where} vaut '{given}'",
        "it may be {allowed}",
        "valeurs possibles : {allowed}",
    ),
    "entry-value-near": Message(
        "{procedure}: {where} is '{given}'",
        "{procedure} : {where} vaut '{given}'",
        "did you mean '{near}'? It may be {allowed}",
        "vouliez-vous dire '{near}' ? Valeurs possibles : {allowed}",
    ),
    "entry-out-of-range": Message(
        "{procedure}: {where} is {value:g}, where {range}",
        "{procedure} : {where} vaut {value:g}, or {range}",
        "{where}: {en}",
        "{where} : {fr}",
    ),
    "entry-not-increasing": Message(
        "{procedure}: {where} {count:?does not increase: {value:g} follows "
        "{before:g} (values {place} and {next_place})|is empty}",
        "{procedure} : {where} {count:?ne croît pas : {value:g} suit "
        "{before:g} (valeurs {place} et {next_place})|est vide}",
        "{where}: {en}",
        "{where} : {fr}",
    ),
    "entry-unusual": Message(
        "{procedure}: {where} is {value:g}, mostly {range}",
        "{procedure} : {where} vaut {value:g}, d'ordinaire {range}",
        "{where}: {en}; is it in another unit, a percentage?",
        "{where} : {fr} ; est-ce une autre unité, un pourcentage ?",
        severity="warning",
    ),
    "out-of-range": Message(
        "{operator}: {name} is {value:g}, where {range}",
        "{operator} : {name} vaut {value:g}, or {range}",
        "{en:?{name}: {en}}",
        "{fr:?{name} : {fr}}",
    ),
    "unusual": Message(
        "{operator}: {name} is {value:g}, mostly {range}",
        "{operator} : {name} vaut {value:g}, d'ordinaire {range}",
        "{en:?{name}: {en}}",
        "{fr:?{name} : {fr}}",
        severity="warning",
    ),
    "not-increasing": Message(
        "{operator}: {name} {count:?does not increase: {value:g} follows "
        "{before:g} (values {place} and {next_place})|is empty}",
        "{operator} : {name} {count:?ne croît pas : {value:g} suit "
        "{before:g} (valeurs {place} et {next_place})|est vide}",
        "{en:?{name}: {en}}",
        "{fr:?{name} : {fr}}",
    ),
    "entry-not-finite": Message(
        "{procedure}: {where} has values that are not finite numbers",
        "{procedure} : {where} a des valeurs qui ne sont pas des nombres finis",
    ),
    "entry-no-curve": Message(
        "{procedure}: {where} holds no curve", "{procedure} : {where} ne contient aucune évolution"
    ),
    "entry-refused": Message(
        "{procedure}: the entry {where} is not available: {en}",
        "{procedure} : l'indice {where} n'est pas disponible : {fr}",
    ),
    "entry-unknown": Message(
        "{where} is no entry of {procedure} and has no effect",
        "{where} n'est pas un indice de {procedure} et n'a aucun effet",
        "did you mean '{near}'?",
        "vouliez-vous dire '{near}' ?",
        severity="warning",
    ),
    "entry-of-another": Message(
        "{where} is no entry of {procedure} and has no effect",
        "{where} n'est pas un indice de {procedure} et n'a aucun effet",
        "it is one of {owners}",
        "c'en est un de {owners}",
        severity="warning",
    ),
    "entry-unread": Message(
        "{where} is no entry of {procedure} and nothing in the script reads it",
        "{where} n'est pas un indice de {procedure} et rien dans le script ne le lit",
        "`ssilang help {procedure}` lists its entries",
        "`ssilang help {procedure} --lang fr` en donne la liste",
        severity="warning",
    ),
    "entries-without-effect": Message(
        "{procedure} accepts {names:and} without effect{en:?: {en}}",
        "{procedure} accepte {names:and} sans effet{fr:? : {fr}}",
        "`ssilang help {procedure}` lists the entries that it reads",
        "`ssilang help {procedure} --lang fr` donne la liste de ceux qu'il lit",
        severity="warning",
    ),
    "refused-entry": Message(
        "{index} is refused: {problem}",
        "{index} est refusé : {problem}",
        "{problem!h}",
        "{problem!h}",
    ),
    "no-such-loop": Message(
        "no open loop or procedure is called {name}",
        "aucune boucle ou procédure ouverte ne s'appelle {name}",
    ),
    "interrupted": Message("interrupted", "interrompu"),
    "reader-left": Message(
        "ended here: whoever read what the run prints left",
        "arrêté ici : le lecteur de ce que le calcul affiche est parti",
    ),
    # ---- found by checking, and warnings
    "undefined-name": Message(
        "{name} was never given a value before this line",
        "{name} n'a pas reçu de valeur avant cette ligne",
        "{near_name}",
        "{near_name}",
    ),
    "undefined-table": Message(
        "{name} is used as a TABLE but was never given a value before this line",
        "{name} est utilisé comme TABLE mais n'a pas reçu de valeur avant cette ligne",
        "make the table first: {name} = TABL ;",
        "créez d'abord la table : {name} = TABL ;",
    ),
    "unused-name": Message(
        "{name} gets a value that nothing reads",
        "{name} reçoit une valeur que rien ne lit",
        severity="warning",
    ),
    "unused-names": Message(
        "names get values that nothing reads: {names}",
        "des noms reçoivent des valeurs que rien ne lit : {names}",
        "in brackets: the line where each gets its first value",
        "entre parenthèses : la ligne où chacun reçoit sa première valeur",
        severity="warning",
    ),
    "near-word": Message(
        "{operator} knows no word '{name}'",
        "{operator} ne connaît pas le mot '{name}'",
        "did you mean '{near}'?",
        "vouliez-vous dire '{near}' ?",
        severity="warning",
    ),
    "perhaps-misspelt": Message(
        "{name} has no value and is read as a word; {like} has one",
        "{name} n'a pas de valeur et se lit comme un mot ; {like} en a une",
        "if the word is meant, write it between quotes: '{name}'",
        "si c'est bien le mot, écrivez-le entre apostrophes : '{name}'",
        severity="warning",
    ),
    "shadowed-operator": Message(
        "{name} is also an operator, which this name hides from here on",
        "{name} est aussi un opérateur, que ce nom cache à partir d'ici",
        "choose another name, or write the operator between quotes: '{name}'",
        "choisissez un autre nom, ou écrivez l'opérateur entre apostrophes : '{name}'",
        severity="warning",
    ),
    "behind-condition": Message(
        "{name} stands behind the condition of SI, in the same statement: it is not run",
        "{name} suit la condition de SI dans la même instruction : il n'est pas exécuté",
        "a ; is probably missing between the condition and {name}",
        "il manque sans doute un ; entre la condition et {name}",
        severity="warning",
    ),
    "unread-object": Message(
        "nothing in these parentheses reads {name}, a {found}: they stand for their result alone",
        "rien dans ces parenthèses ne lit {name}, un {found} : elles valent leur seul résultat",
        "an operator between two objects is missing before {name}, or {name} is too much",
        "il manque un opérateur entre deux objets devant {name}, ou {name} est de trop",
        severity="warning",
    ),
    "overrides-procedure": Message(
        "{name} replaces the procedure of that name in the standard library",
        "{name} remplace la procédure de ce nom de la bibliothèque",
        severity="warning",
    ),
    "integer-division": Message(
        "{left} / {right} is {value}: a quotient of integers is cut to an integer",
        "{left} / {right} vaut {value} : le quotient de deux entiers est tronqué",
        "write {left}. / {right} for {exact:g}",
        "écrivez {left}. / {right} pour {exact:g}",
        severity="warning",
    ),
    # ---- ERRE
    "erre": Message("{message}", "{message}"),
    # ---- hints that other messages hold
    "write-condition": Message(
        "a condition is written SI (A > 3) ; ... SINON ; ... FINSI ;",
        "une condition s'écrit SI (A > 3) ; ... SINON ; ... FINSI ;",
    ),
    "write-loop": Message(
        "a loop is written REPE LOOP1 10 ; ... FIN LOOP1 ; &LOOP1 counts its turns",
        "une boucle s'écrit REPE TOUR1 10 ; ... FIN TOUR1 ; &TOUR1 compte ses tours",
    ),
    "write-leaving": Message(
        "a loop is left by QUIT LOOP1 ; ITER LOOP1 ; goes to its next turn",
        "on sort d'une boucle par QUIT TOUR1 ; ITER TOUR1 ; passe au tour suivant",
    ),
    "write-printing": Message(
        "printing is written MESS 'A is ' A ;",
        "un affichage s'écrit MESS 'A vaut ' A ;",
    ),
    "write-extremes": Message(
        "the largest value is MAXI, the smallest MINI; with 'ABS', by absolute values",
        "la plus grande valeur est MAXI, la plus petite MINI ; avec 'ABS', en valeur absolue",
    ),
    "write-comparison": Message(
        "comparisons are written A EGA B, A NEG B, A > B, A < B, A >EG B, A <EG B",
        "les comparaisons s'écrivent A EGA B, A NEG B, A > B, A < B, A >EG B, A <EG B",
    ),
    "write-picture": Message(
        "TRAC draws meshes and fields, DESS curves",
        "TRAC dessine les maillages et les champs, DESS les courbes",
    ),
    "write-power": Message("a power is written A ** 3", "une puissance s'écrit A ** 3"),
    "write-weight": Message(
        "the weight of bodies is (MASS MODL1 MAT1) * (MANU 'CHPO' MAIL1 2 'UX' 0. 'UY' -9.81)",
        "le poids de corps est (MASS MODL1 MAT1) * (MANU 'CHPO' MAIL1 2 'UX' 0. 'UY' -9.81)",
    ),
    "write-root": Message(
        "a square root is written X ** 0.5", "une racine carrée s'écrit X ** 0.5"
    ),
    "write-count": Message(
        "the number of items of a list is DIME, of the cells of a mesh NBEL, of its nodes NBNO",
        "le nombre d'éléments d'une liste est DIME, celui des mailles d'un maillage NBEL, de ses "
        "noeuds NBNO",
    ),
    "longer-word": Message(
        "{word} is read as the operator of its first four letters: {problem}\n",
        "{word} est lu comme l'opérateur de ses quatre premières lettres : {problem}\n",
    ),
    "write-procedure": Message(
        "a procedure is written DEBP NAME A*FLOTTANT ; ... FINP B ;",
        "une procédure s'écrit DEBP NOM A*FLOTTANT ; ... FINP B ;",
    ),
    "write-truth": Message(
        "these values are VRAI and FAUX; A ET B, A OU B, NON A combine them",
        "ces valeurs sont VRAI et FAUX ; A ET B, A OU B, NON A les combinent",
    ),
    "write-comment": Message(
        "a comment is a line whose first character is *",
        "un commentaire est une ligne dont le premier caractère est *",
    ),
    "write-item": Message(
        "an item of a list is EXTR LIST1 3, of a table TAB1 . 3",
        "un élément d'une liste est EXTR LIST1 3, d'une table TAB1 . 3",
    ),
    "excess-order": Message(
        "a phrase runs from left to right: put parentheses around what belongs together",
        "une phrase va de gauche à droite : mettez entre parenthèses ce qui va ensemble",
    ),
    "excess-join": Message(
        "two objects of a kind are joined by ET: (A ...) ET (B ...)",
        "deux objets de même type se réunissent par ET : (A ...) ET (B ...)",
    ),
    "excess-numbers": Message(
        "numbers side by side make a POINT where OPTI DIME 2 (or 3) was set and there are as many",
        "des nombres côte à côte font un POINT si OPTI DIME 2 (ou 3) le précède et qu'il y "
        "en a autant",
    ),
    "excess-parentheses": Message(
        "operands stand behind their operator, without parentheses around them all: {caller} A B ;",
        "les opérandes suivent leur opérateur, sans parenthèses autour de tous : {caller} A B ;",
    ),
    "no-result-at-all": Message(
        "what stands on the right of = gives no result; a procedure gives what stands behind "
        "its FINP",
        "ce qui est à droite de = ne donne aucun résultat ; une procédure donne ce qui suit "
        "son FINP",
    ),
    "fewer-results": Message(
        "{count} names stand on the left of =, the right side gives fewer results",
        "{count} noms sont à gauche de =, la partie droite donne moins de résultats",
    ),
    "item-of-list": Message(
        "an item of a list is taken by EXTR: EXTR {name} 1",
        "un élément d'une liste se prend par EXTR : EXTR {name} 1",
    ),
    "only-tables-have-indices": Message(
        "only a TABLE (made by TABL) and an OBJET have indices; was {name} given another value?",
        "seuls une TABLE (créée par TABL) et un OBJET ont des indices ; {name} a-t-il changé ?",
    ),
    "word-in-quotes": Message(
        "{name} has a value here: the word {name} is written between quotes, '{name}'\n",
        "{name} a ici une valeur : le mot {name} s'écrit entre apostrophes, '{name}'\n",
    ),
    "did-you-mean": Message("did you mean {near}?", "vouliez-vous dire {near} ?"),
    # ---- parts of other sentences
    "label-error": Message("error", "erreur"),
    "label-warning": Message("warning", "avertissement"),
    "labelled": Message("{label}: {head}", "{label} : {head}"),
    "called-by": Message("called by {name} at", "appelé par {name},"),
    "held-word": Message(
        "'{word}', the value of {holder}, names an operator, which ran: MOT {holder} takes it as "
        "a word, EGA {holder} 'OTHER' compares it",
        "'{word}', la valeur de {holder}, nomme un opérateur, exécuté : MOT {holder} le prend "
        "comme mot, EGA {holder} 'AUTRE' le compare",
    ),
    "unread-word": Message(
        "'{word}' was not read: did you mean '{near}'?",
        "'{word}' n'a pas été lu : vouliez-vous dire '{near}' ?",
    ),
    "quoted-operator": Message(
        "'{word}' names an operator, which quotes do not keep from running: MOT '{word}' is the "
        "word",
        "'{word}' nomme un opérateur, que les apostrophes n'empêchent pas d'agir : MOT '{word}' "
        "est le mot",
    ),
    "word-and-name": Message(
        "in quotes, or behind MOT, {word} is a word: {word} alone is the object of that name",
        "entre apostrophes, ou derrière MOT, {word} est un mot : {word} seul est l'objet de ce nom",
    ),
    "found-word": Message(", found {found}", ", trouvé {found}"),
    "nothing": Message("nothing", "rien"),
    "of-type": Message(" of type {wanted}", " de type {wanted}"),
    "ended-by-word": Message(
        "; it ends behind a word, here {before}", " ; un mot l'arrête, ici {before}"
    ),
    "bare-word": Message(
        "{word} was never given a value{near:? (did you mean {near}?)}\n",
        "{word} n'a jamais reçu de valeur{near:? (vouliez-vous dire {near} ?)}\n",
    ),
    "point-in-parentheses": Message(
        "a point inside a phrase is written in parentheses: (0. 1.)\n",
        "un point dans une phrase s'écrit entre parenthèses : (0. 1.)\n",
    ),
    "any-object": Message("an object", "un objet"),
    "a-object-of-type": Message("a {kind}", "{feminine:?une|un} {kind}"),
    "an-object-of-type": Message("an {kind}", "{feminine:?une|un} {kind}"),
    "one-of-types": Message("one of {types:or}", "l'un des types {types:or}"),
    "no-keyword": Message(
        "'{word}' is no keyword of {operator}: did you mean '{near}'?\n",
        "'{word}' n'est pas un mot-clé de {operator} : vouliez-vous dire '{near}' ?\n",
    ),
    "give-a-value": Message(
        "give it a value first ({word} = ... ;), or see the operators with `ssilang help`",
        "donnez-lui d'abord une valeur ({word} = ... ;), ou voyez `ssilang help`",
    ),
    "not-built": Message(
        "{name} is a Cast3M {operator:?operator|procedure} that ssilang does not have",
        "{name} est un mot de Cast3M ({operator:?opérateur|procédure}) que ssilang n'a pas",
    ),
    "out-of-scope": Message(
        "{name} is a Cast3M {operator:?operator|procedure} ({subject}), out of ssilang's scope",
        "{name} est un mot de Cast3M ({operator:?opérateur|procédure}, {subject}), hors du champ "
        "de ssilang",
    ),
    "indices-known": Message(
        "{known:?its indices are: {known}|it is empty}",
        "{known:?ses indices sont : {known}|elle est vide}",
    ),
    "innermost-block": Message(
        "; the innermost open block is {where} of line {line}",
        " ; le bloc ouvert le plus intérieur est {where}, ligne {line}",
    ),
}
