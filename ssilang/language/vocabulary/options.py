"""Options of OPTI: meaning, values, default."""

from __future__ import annotations

from ssilang.language.vocabulary.terms import Option, Word


def _o(
    name: str, takes: str, default: str, en: str, fr: str, values: tuple[Word, ...] = ()
) -> Option:
    return Option(name, en, fr, (), "", takes, values, default)


def _kept(name: str, takes: str, default: str, en: str, fr: str) -> Option:
    """An option that VALE gives back and that changes nothing here."""
    return _o(name, takes, default, f"{en} (kept, without effect)", f"{fr} (gardé, sans effet)")


_MODES = (
    Word(
        "PLAN", "The plane x y; followed by CONT, DEFO (default) or GENE",
        "Le plan x y ; suivi de CONT, DEFO (par défaut) ou GENE",
    ),
    Word("AXIS", "Bodies of revolution: r, z", "Corps de révolution : r, z"),
    Word(
        "FOURIER", "Bodies of revolution under loads of one harmonic: FOUR and its number",
        "Corps de révolution sous un harmonique de chargement : FOUR et son numéro",
    ),
    Word("TRID", "Space x y z", "L'espace x y z"),
    Word("UNID", "One dimension", "Une dimension"),
    Word(
        "FREQ", "Calculations in frequency; the hypothesis on displacements stays",
        "Calculs en fréquence ; l'hypothèse sur les déplacements demeure",
    ),
    Word("CONT", "Behind PLAN: plane stress", "Derrière PLAN : contraintes planes"),
    Word("DEFO", "Behind PLAN: plane strain", "Derrière PLAN : déformations planes"),
    Word(
        "GENE", "Behind PLAN: generalised plane strain",
        "Derrière PLAN : déformations planes généralisées",
    ),
)  # fmt: skip
_ERRORS = (
    Word("FATALE", "An error ends the run", "Une erreur arrête l'exécution"),
    Word("NORMALE", "As FATALE", "Comme FATALE"),
    Word("CONTROLE", "As FATALE; VALE gives 1", "Comme FATALE ; VALE donne 1"),
    Word("IGNORE", "An error is said and the run goes on", "L'erreur est dite, on continue"),
)
_PICTURES = (
    Word("PNG", "Pictures as PNG files", "Images en fichiers PNG"),
    Word("SVG", "Pictures as SVG files", "Images en fichiers SVG"),
    Word("PDF", "Pictures as PDF files", "Images en fichiers PDF"),
    *(
        Word(name, "An output of Cast3M's: pictures get their usual format",
             "Une sortie de Cast3M : les images gardent leur format habituel")
        for name in (
            "PS", "PSC", "PSC8", "BENSON", "IBM", "GKS", "PHIGS", "X", "MIF", "OPENGL", "XWINDOW",
        )
    ),
)  # fmt: skip
_LANGUAGES = (
    Word("FRAN", "Messages in French", "Messages en français"),
    Word("ANGL", "Messages in English", "Messages en anglais"),
)
_UNITS = (
    Word("SI", "m, N, kg, s, Pa", "m, N, kg, s, Pa"),
    Word("KN-M", "m, kN, t, s, kPa", "m, kN, t, s, kPa"),
    Word("MN-M", "m, MN, kt (1000 t), s, MPa", "m, MN, kt (1000 t), s, MPa"),
    Word("N-MM", "mm, N, t, s, MPa", "mm, N, t, s, MPa"),
)
_SOLVERS = (
    Word(
        "AUTO", "The first that suits, by size, memory and what is installed; MULTIGRILLE for "
        "large solids and where memory would not hold the factor; PETSC in its place where the "
        "run has it, from a million unknowns on or where memory would not hold the factor",
        "Le premier qui convient, selon la taille, la mémoire et ce qui est installé ; MULTIGRILLE "
        "pour les grands massifs et quand la mémoire ne contiendrait pas la factorisation ; PETSC "
        "à sa place, si l'exécution en dispose, à partir d'un million d'inconnues ou quand la "
        "mémoire ne contiendrait pas la factorisation",
    ),
    Word(
        "PETSC", "PETSc over MPI, started by the command that ssilang --petsc or SSILANG_PETSC "
        "gives: MUMPS factorises, and multigrid (GAMG) iterates where memory would not hold that",
        "PETSc sur MPI, lancé par la commande que donne ssilang --petsc ou SSILANG_PETSC : MUMPS "
        "factorise, et le multigrille (GAMG) itère quand la mémoire n'y suffirait pas",
    ),
    Word(
        "MULTIGRILLE", "Conjugate gradients with multigrid, for symmetric positive systems; a "
        "number may follow: the residual, of the second member, at which they end (1.E-12)",
        "Gradients conjugués et multigrille, pour les systèmes symétriques positifs ; un nombre "
        "peut suivre : le résidu, rapporté au second membre, où ils s'arrêtent (1.E-12)",
    ),
)  # fmt: skip

WORDS = (
    _o("DIME", "ENTIER", "", "Number of dimensions of space: 1, 2 or 3",
       "Nombre de dimensions de l'espace : 1, 2 ou 3"),
    _o("ELEM", "", "", "Cells that meshing operators make (SEG2 TRI3 QUA4 CUB8 ...)",
       "Mailles que font les opérateurs de maillage (SEG2 TRI3 QUA4 CUB8 ...)"),
    _o("DENS", "FLOTTANT", "", "Mesh size that points made from now on carry",
       "Taille de maille portée par les points créés ensuite"),
    _o("COUL", "MOT", "DEFA", "Colour of the meshes made from now on",
       "Couleur des maillages créés ensuite"),
    _o("MODE", "", "PLAN DEFO (DIME 2), TRID (DIME 3)", "Hypothesis of the calculation",
       "Hypothèse de calcul", _MODES),
    _o("INCO", "LISTMOTS", "", "Further unknowns and their duals, two lists of words",
       "Inconnues supplémentaires et leurs duales, deux listes de mots"),
    _o("UNIT", "MOT", "",
       "Units that the deck is in, between quotes: from there on MATE and CARA warn of numbers "
       "that look like another unit, and pictures, tables and the summary say units; no number "
       "is converted (not in Cast3M)",
       "Unités du jeu de données, entre apostrophes : à partir de là, MATE et CARA signalent les "
       "nombres qui semblent être dans une autre unité, et les images, les tableaux et le résumé "
       "disent les unités ; aucun nombre n'est converti (absent de Cast3M)",
       _UNITS),
    _o("SOLV", "MOT", "AUTO",
       "Solver of linear systems in RESO, DYNAMIC, PASAPAS and VIBR (not in Cast3M)",
       "Solveur des systèmes linéaires de RESO, DYNAMIC, PASAPAS et VIBR (absent de Cast3M)",
       _SOLVERS),
    _o("ERRE", "", "FATALE", "What an error does", "Ce que fait une erreur", _ERRORS),
    _kept("ECHO", "ENTIER", "1", "1: statements are printed as they run, 0: not",
          "1 : les instructions sont affichées à leur exécution, 0 : non"),
    _kept("DEBU", "ENTIER", "0", "1: stops before each statement of procedures",
          "1 : arrêt avant chaque instruction des procédures"),
    _kept("VERI", "ENTIER", "0", "1: operands are checked more",
          "1 : vérifications supplémentaires"),
    _kept("SOUC", "ENTIER", "0", "Level of the flag of doubts (see the operator SOUC)",
          "Niveau de l'indicateur de soucis (voir l'opérateur SOUC)"),
    _o("LANG", "", "", "Language of messages", "Langue des messages", _LANGUAGES),
    _o("TRAC", "", "PNG", "What pictures are written as (TRAC, DESS)",
       "Format des images (TRAC, DESS)", _PICTURES),
    _o("FTRA", "MOT", "", "File of pictures", "Fichier des images"),
    _o("ISOV", "MOT", "SURFACE", "How iso-values are drawn: SURFACE, LIGNE",
       "Tracé des isovaleurs : SURFACE, LIGNE"),
    _o("OEIL", "POINT", "", "Point from which pictures in space are seen",
       "Point d'où l'on voit les images dans l'espace"),
    _o("SORT", "MOT", "", "File that SORT writes", "Fichier qu'écrit SORT"),
    _o("SAUV", "MOT", "", "File that SAUV writes", "Fichier qu'écrit SAUV"),
    _o("REST", "MOT", "", "File that REST reads", "Fichier que lit REST"),
    _o("ACQU", "MOT", "", "File that ACQU reads", "Fichier que lit ACQU"),
    _o("LECT", "MOT", "", "File that LIRE reads", "Fichier que lit LIRE"),
    _o("IMPR", "MOT", "", "File that takes what is printed; a number ends that",
       "Fichier où va l'affichage ; un numéro y met fin"),
    _o("DONN", "MOT", "", "Script that is read at this place", "Script lu à cet endroit"),
    _o("PETI", "FLOTTANT", "2.2E-308", "Smallest positive number", "Plus petit nombre positif"),
    _o("GRAN", "FLOTTANT", "1.8E308", "Largest number", "Plus grand nombre"),
    _o("PREC", "FLOTTANT", "2.2E-16", "Relative precision of numbers",
       "Précision relative des nombres"),
    _kept("NORM", "", "", "How unknowns are scaled: AUTO, ANNU, or lists of words and numbers",
          "Normalisation des inconnues : AUTO, ANNU, ou listes de mots et de réels"),
    _kept("ASSI", "ENTIER", "0", "Number of the assistant", "Numéro de l'assistant"),
    _kept("ATTE", "ENTIER", "0", "Waiting", "Attente"),
    _kept("EPTR", "ENTIER", "1", "Thickness of lines in pictures",
          "Épaisseur des lignes dans les images"),
    _kept("IMPI", "ENTIER", "0", "Level of printing", "Niveau d'impression"),
    _kept("NBP", "ENTIER", "0", "Number of points", "Nombre de points"),
    _kept("NGMA", "ENTIER", "100000", "Largest number of cells", "Nombre maximal de mailles"),
    _kept("NIVE", "ENTIER", "19", "Level of the files of SAUV", "Niveau des fichiers de SAUV"),
    _kept("PLAC", "ENTIER", "0", "Memory", "Place en mémoire"),
    _kept("SURV", "ENTIER", "", "Watching of an object", "Surveillance d'un objet"),
    _kept("ZERO", "ENTIER", "4", "Origin of the curves drawn", "Origine des courbes tracées"),
    _kept("CADR", "FLOTTANT", "30.", "Size of the frame of pictures",
          "Taille du cadre des images"),
    _kept("OMBR", "LOGIQUE", "VRAI", "Shadows in pictures", "Ombres dans les images"),
    _kept("PARA", "LOGIQUE", "FAUX", "Work in parallel", "Travail en parallèle"),
    _kept("LOCA", "LOGIQUE", "FAUX", "Local variables", "Variables locales"),
    _kept("COSC", "MOT", "NOIR", "Colour of the screen", "Couleur de l'écran"),
    _kept("POLI", "MOT", "8_BY_13", "Letters of menus", "Police des menus"),
    _kept("POTR", "MOT", "COURIER_14", "Letters of pictures", "Police des images"),
    _kept("RESO", "MOT", "DIRECTE", "How RESO solves", "Méthode de RESO"),
    _kept("EPSI", "MOT", "LINEAIRE", "Kind of strains that EPSI computes",
          "Type de déformations que calcule EPSI"),
    _kept("NAVI", "MOT", "", "Hypothesis of fluids", "Hypothèse des fluides"),
    _kept("TITR", "MOT", "", "Title", "Titre"),
    _kept("ECRA", "MOT", "", "Screen", "Écran"),
)  # fmt: skip
