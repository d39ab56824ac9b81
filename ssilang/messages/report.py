"""What the report of a run says, and what ssilang/cli/report refuses."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    # refusals
    "no-folder": Message(
        "'{folder}' is not a folder",
        "'{folder}' n'est pas un répertoire",
        "a run of case.ssi leaves its results in results/case",
        "un calcul de cas.ssi laisse ses résultats dans results/cas",
    ),
    "no-run": Message(
        "'{folder}' holds no results of a run: there is no summary.json, no series, no table",
        "'{folder}' ne contient pas de résultats : ni summary.json, ni série, ni table",
        "a run of case.ssi leaves its results in results/case",
        "un calcul de cas.ssi laisse ses résultats dans results/cas",
    ),
    "damaged": Message(
        "'{path}' cannot be read: {problem}",
        "'{path}' est illisible : {problem}",
        "run the deck again",
        "relancez le calcul",
    ),
    "not-a-summary": Message(
        "'{path}' is not the summary of a run: {problem}",
        "'{path}' n'est pas le bilan d'un calcul : {problem}",
        "run the deck again",
        "relancez le calcul",
    ),
    "no-pyvista": Message(
        "The scene needs pyvista, which cannot be loaded here: {problem}",
        "La scène demande pyvista, qui ne peut être chargé ici : {problem}",
    ),
    "series-gone": Message("{name} is gone: no scene", "{name} a disparu : pas de scène"),
    "series-damaged": Message("{name} is damaged: no scene", "{name} est endommagé : pas de scène"),
    "instants-left": Message(
        "{name}: {count} {count:instant is|instants are} damaged or have another mesh, and left "
        "out",
        "{name} : {count} {count:instant endommagé ou d'un autre maillage laissé|instants "
        "endommagés ou d'un autre maillage laissés} de côté",
    ),
    "nothing-to-see": Message("{name} holds nothing to see", "{name} ne contient rien à montrer"),
    "written": Message("report: {path} ({size:.1f} MB)", "rapport : {path} ({size:.1f} Mo)"),
    # head
    "ran": Message("ran to its end", "terminé"),
    "failed": Message(
        "the run failed (exit code {code})", "le calcul a échoué (code de sortie {code})"
    ),
    "not-ended": Message(
        "the run has not come to its end: there is no summary",
        "le calcul n'est pas arrivé à son terme : il n'y a pas de bilan",
    ),
    "line": Message("line {line}:", "ligne {line} :"),
    "statements": Message(
        "{count} {count:statement|statements}", "{count} {count:instruction|instructions}"
    ),
    "memory": Message("{size:.0f} MB of memory", "{size:.0f} Mo de mémoire"),
    "units": Message("units {system}: {units}", "unités {system} : {units}"),
    "no-units": Message(
        "units: those of the deck's numbers (OPTI 'UNIT' names none)",
        "unités : celles des nombres du jeu (OPTI 'UNIT' n'en nomme pas)",
    ),
    "duration": Message("duration", "durée"),
    "checks-held": Message("checks within tolerance", "vérifications dans la tolérance"),
    "energy-imbalance": Message("energy imbalance", "écart d'énergie"),
    "largest-opening": Message("largest opening", "plus grande ouverture"),
    "least-contact": Message("least share in contact", "plus petite part en contact"),
    "not-recorded": Message(
        "This run was made without --report: footings, energies and the scene of a deck that "
        "writes no VTK series are missing. ssilang run DECK --report takes them down.",
        "Ce calcul a été fait sans --report : il manque les semelles, les énergies et la scène "
        "d'un jeu qui n'écrit pas de série VTK. ssilang run JEU --report les enregistre.",
    ),
    "deck-gone": Message(
        "The deck is no longer where it was, or no longer what ran.",
        "Le jeu n'est plus à sa place, ou n'est plus ce qui a été calculé.",
    ),
    "left-out": Message(
        "Left out: {calculations} further {calculations:calculation|calculations}, {drawings} "
        "further {drawings:picture|pictures} of curves.",
        "Laissés de côté : {calculations} {calculations:autre calcul|autres calculs}, {drawings} "
        "{drawings:autre image|autres images} de courbes.",
    ),
    "footings-left": Message(
        "Left out: {count} smaller {count:footing|footings}.",
        "{count:Laissée de côté|Laissées de côté} : {count} plus {count:petite|petites} "
        "{count:semelle|semelles}.",
    ),
    "unread": Message("Damaged, not shown: {names}", "Endommagé, pas montré : {names}"),
    "made": Message(
        "Made by ssilang. The file holds all that it shows; it asks for nothing elsewhere.",
        "Fait par ssilang. Le fichier contient tout ce qu'il montre ; il ne demande rien ailleurs.",
    ),
    "licences": Message(
        "uPlot and vtk.js are in this file; their licences",
        "Ce fichier contient uPlot et vtk.js ; leurs licences",
    ),
    # sections
    "checks": Message("checks", "vérifications"),
    "warnings": Message("warnings", "avertissements"),
    "scene": Message("scene", "scène"),
    "footing": Message("footing", "semelle"),
    "footing-number": Message("footing {number}", "semelle {number}"),
    "energies": Message("energies", "énergies"),
    "curves": Message("curves of the deck", "courbes du jeu"),
    "tables": Message("histories in files", "évolutions dans les fichiers"),
    "largest": Message("largest values, over all steps", "plus grandes valeurs, sur tous les pas"),
    "pictures": Message("pictures", "images"),
    "pictures-left": Message(
        "{count} {count:picture is|pictures are} too large for this page and left out.",
        "{count} {count:image trop grande est laissée|images trop grandes sont laissées} de côté.",
    ),
    "calculations": Message("calculations", "calculs"),
    "deck": Message("deck", "jeu de données"),
    "files": Message("files", "fichiers"),
    # tables
    "name": Message("figure", "grandeur"),
    "value": Message("value", "valeur"),
    "expected": Message("expected", "attendu"),
    "tolerance": Message("tolerance", "tolérance"),
    "used": Message("of the tolerance", "de la tolérance"),
    "held": Message("held", "tenue"),
    "missed": Message("missed", "manquée"),
    "calculation": Message("calculation", "calcul"),
    "quantity": Message("quantity", "grandeur"),
    "place": Message("place", "lieu"),
    "unknowns": Message("unknowns", "inconnues"),
    "interface-unknowns": Message("of joints", "des joints"),
    "steps": Message("steps", "pas"),
    "method": Message("method", "méthode"),
    "solver": Message("solver", "solveur"),
    "iterations": Message("most iterations", "itérations au plus"),
    "seconds": Message("seconds", "secondes"),
    # quantities
    "time": Message("time", "temps"),
    "share": Message("share in contact", "part en contact"),
    "toe-pressure": Message("toe pressure (largest)", "pression sous l'arête (la plus grande)"),
    "toe-force": Message("largest force of a joint", "plus grande force d'un joint"),
    "footing-opening": Message("largest opening", "plus grande ouverture"),
    "force": Message("normal force on the soil", "force normale sur le sol"),
    "loops": Message("moment against rotation", "moment en fonction de la rotation"),
    "rotation": Message("rotation", "rotation"),
    "moment": Message("moment", "moment"),
    "about": Message("about {axis}", "autour de {axis}"),
    "opening": Message("opening of joints", "ouverture des joints"),
    "pressure": Message("pressure of joints", "pression des joints"),
    "compression": Message("compression of joints", "compression des joints"),
    "shear": Message("shear of joints", "cisaillement des joints"),
    "displacement": Message("displacement", "déplacement"),
    "reaction": Message("reaction", "réaction"),
    "energy": Message("energy", "énergie"),
    "kinetic": Message("kinetic", "cinétique"),
    "elastic": Message("elastic", "élastique"),
    "joints": Message("stored in joints", "stockée dans les joints"),
    "lost": Message("lost in joints", "perdue dans les joints"),
    "damped": Message("damped", "amortie"),
    "work": Message("work of loads", "travail des charges"),
    "imbalance": Message("imbalance", "écart"),
    "stress-vertical": Message("vertical stress", "contrainte verticale"),
    "stress-mises": Message("von Mises stress", "contrainte de von Mises"),
    "magnitude": Message("displacement (length)", "déplacement (norme)"),
    "ux": Message("displacement x", "déplacement x"),
    "uy": Message("displacement y", "déplacement y"),
    "uz": Message("displacement z", "déplacement z"),
    "plain": Message("one colour", "une couleur"),
    # curves and scene
    "zoom": Message(
        "Drag to zoom, double click to see all; or the buttons.",
        "Tirez pour agrandir, double-clic pour tout voir ; ou les boutons.",
    ),
    "zoom-in": Message("zoom in", "agrandir"),
    "zoom-out": Message("zoom out", "réduire"),
    "show-all": Message("show all", "tout voir"),
    "choose": Message("show", "montrer"),
    "colour": Message("colour", "couleur"),
    "warp": Message("displacements times", "déplacements fois"),
    "play": Message("play", "jouer"),
    "pause": Message("pause", "pause"),
    "reset": Message("whole view", "vue entière"),
    "edges": Message("edges", "arêtes"),
    "ghost": Message("at rest", "au repos"),
    "see-through": Message("see-through", "transparent"),
    "mode": Message("mode", "mode"),
    "modes": Message("modes {name}", "modes {name}"),
    "mesh": Message("mesh", "maillage"),
    "no-webgl": Message(
        "This browser draws no 3D scenes (WebGL 2 is off or missing).",
        "Ce navigateur ne dessine pas de scène 3D (WebGL 2 manque ou est désactivé).",
    ),
    "scene-help": Message(
        "Drag to turn, Shift and drag to move, wheel or two fingers to zoom; with the keyboard: "
        "arrows turn, + and - zoom.",
        "Tirez pour tourner, Maj et tirez pour déplacer, molette ou deux doigts pour agrandir ; au "
        "clavier : les flèches tournent, + et - agrandissent.",
    ),
    "scenes-left": Message(
        "{count} further {count:scene|scenes} left out",
        "{count} {count:autre scène|autres scènes} de côté",
    ),
    # the verdict of a footing
    "verdict": Message("Verdict of the footing", "Bilan de la semelle"),
    "area": Message("area of the footing (m2)", "aire de la semelle (m2)"),
    "capacity": Message("pressure that the soil bears (Pa)", "pression que le sol supporte (Pa)"),
    "friction": Message("friction coefficient", "coefficient de frottement"),
    "motions": Message("uplift and settlement (m)", "soulèvement et enfoncement (m)"),
    "factors": Message("factors of safety", "coefficients de sécurité"),
    "floor": Message("floor {number}, {component}", "plancher {number}, {component}"),
    "broadened": Message("broadened", "élargi"),
    "floor-head": Message("floor", "plancher"),
    "component": Message("component", "composante"),
    "damping": Message("damping", "amortissement"),
    "acceleration": Message("largest acceleration", "plus grande accélération"),
    "frequency": Message("frequency (Hz)", "fréquence (Hz)"),
    "verdict-uplift": Message("uplift (m)", "soulèvement (m)"),
    "verdict-settlement": Message("settlement (m)", "enfoncement (m)"),
    "verdict-overturning": Message("overturning", "renversement"),
    "verdict-sliding": Message("sliding", "glissement"),
    # a sweep
    "not-a-sweep": Message(
        "'{path}' is not the table of a sweep",
        "'{path}' n'est pas la table d'un balayage",
        "run the sweep again",
        "relancez le balayage",
    ),
    "sweep-ran": Message("all runs ended well", "tous les calculs ont abouti"),
    "sweep-failed": Message(
        "{count} {count:run|runs} failed", "{count} {count:calcul en échec|calculs en échec}"
    ),
    "sweep-runs": Message("Runs", "Calculs"),
    "sweep-figures": Message("Figures over what was swept", "Valeurs selon ce qui varie"),
    "sweep-histories": Message("Histories of all runs", "Histoires de tous les calculs"),
    "sweep-joined": Message(
        "One table each: number of the run, its values, then the columns that the runs wrote.",
        "Une table chacune : numéro du calcul, ses valeurs, puis les colonnes écrites par les "
        "calculs.",
    ),
    "sweep-seconds": Message("work of all runs", "travail de tous les calculs"),
    "sweep-error": Message("error", "erreur"),
    "sweep-rows-left": Message(
        "The first {count} runs; sweep.csv has all of them.",
        "Les {count} premiers calculs ; sweep.csv les a tous.",
    ),
    "sweep-lines-left": Message("{count} more in sweep.csv", "{count} de plus dans sweep.csv"),
}
