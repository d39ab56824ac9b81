"""What ssilang/io refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "checkpoint-of-version": Message(
        "the checkpoints in '{folder}' were written by ssilang {version}, this is {own}",
        "les points de reprise de '{folder}' ont été écrits par ssilang {version}, celui-ci est "
        "{own}",
        "go on with that version, or run without --resume",
        "continuer avec cette version, ou calculer sans --resume",
    ),
    "checkpoint-of-deck": Message(
        "the checkpoints in '{folder}' belong to another deck, or to this one before it was "
        "changed",
        "les points de reprise de '{folder}' viennent d'un autre jeu de données, ou de celui-ci "
        "avant qu'il ne change",
        "put the deck back as it was, or run without --resume",
        "remettre le jeu tel qu'il était, ou calculer sans --resume",
    ),
    "checkpoint-of-parameters": Message(
        "the checkpoints in '{folder}' belong to a run with other parameters: {before} then, {now} "
        "now",
        "les points de reprise de '{folder}' viennent d'un calcul avec d'autres paramètres : "
        "{before} alors, {now} maintenant",
        "give the same --set, or run without --resume",
        "donner les mêmes --set, ou calculer sans --resume",
    ),
    "checkpoint-damaged": Message(
        "'{path}' cannot be read as a checkpoint: {error}",
        "'{path}' ne se lit pas comme un point de reprise : {error}",
        "run without --resume",
        "calculer sans --resume",
    ),
    "field-no-component": Message(
        "the field has no component '{component}', it has {names}",
        "le champ n'a pas de composante '{component}', il a {names}",
    ),
    "no-number-format": Message(
        "'{descriptor}' is no number format",
        "'{descriptor}' n'est pas un format de nombre",
        "write '(F6.2)' or '(I4)'",
        "écrivez '(F6.2)' ou '(I4)'",
    ),
    "nothing-draw-mesh-empty": Message(
        "there is nothing to draw: the mesh is empty",
        "il n'y a rien à tracer : le maillage est vide",
    ),
    "not-viewed": Message(
        "'{path}' cannot be shown: {reason}", "'{path}' ne se montre pas : {reason}"
    ),
    "not-viewed-no-points": Message(
        "'{path}' holds no points, or is damaged",
        "'{path}' ne contient aucun point, ou est endommagé",
    ),
    "not-viewed-absent": Message(
        "there is no file or folder '{path}'", "il n'y a ni fichier ni dossier '{path}'"
    ),
    "not-viewed-kind": Message(
        "'{path}' is of no kind that can be shown",
        "'{path}' n'est pas d'une sorte qui se montre",
        "files end in {known:words}",
        "les fichiers se terminent par {known:words}",
    ),
    "not-viewed-empty": Message(
        "the folder '{path}' holds nothing to show",
        "le dossier '{path}' ne contient rien à montrer",
        "results end in {known:words}",
        "les résultats se terminent par {known:words}",
    ),
    "not-drawn-kind": Message(
        "'{path}' is no name of a picture",
        "'{path}' n'est pas un nom d'image",
        "pictures end in {known:words}; a gif holds all instants",
        "les images se terminent par {known:words} ; un gif contient tous les instants",
    ),
    "no-screen": Message(
        "there is no screen to open a window on",
        "il n'y a pas d'écran où ouvrir une fenêtre",
        "write a picture: ssilang view {path} -o picture.png",
        "écrivez une image : ssilang view {path} -o image.png",
    ),
    "no-such-instant": Message(
        "instant {step} is asked for, there {count:is|are} {count}",
        "l'instant {step} est demandé, il y en a {count}",
    ),
    "no-such-array": Message(
        "there is no field '{field}', the file has {names}",
        "il n'y a pas de champ '{field}', le fichier a {names}",
    ),
    "no-drawing-in-space": Message(
        "the picture is left out: nothing here draws in space without a screen ({reason})",
        "l'image est omise : rien ici ne dessine en 3D sans écran ({reason})",
        "install Mesa, on Debian: apt-get install libegl1 libgl1-mesa-dri; or look at the results "
        "in ParaView (SORT 'VTK')",
        "installez Mesa, sous Debian : apt-get install libegl1 libgl1-mesa-dri ; ou regardez les "
        "résultats dans ParaView (SORT 'VTK')",
    ),
    "marq-no-marker": Message(
        "MARQ has no marker",
        "MARQ n'a pas de marqueur",
        "markers are {markers:words}",
        "les marqueurs sont {markers:words}",
    ),
    "no-marker": Message(
        "'{word}' is no marker",
        "'{word}' n'est pas un marqueur",
        "markers are {markers:words}",
        "les marqueurs sont {markers:words}",
    ),
    "no-line-option": Message(
        "'{word}' is no line option",
        "'{word}' n'est pas une option de ligne",
        "options are {options}",
        "les options sont {options}",
    ),
    "three-points-plane-lie": Message(
        "the three points of the plane lie on a line",
        "les trois points du plan sont alignés",
    ),
    "upright-along-view": Message(
        "one looks along what is to go upwards in the picture",
        "on regarde le long de ce qui doit aller vers le haut de l'image",
    ),
    "curve-asked-evolution": Message(
        "curve {bad} is asked for, the evolution has {count}",
        "la courbe {bad} est demandée, l'évolution en a {count}",
    ),
    "graduations-every-axis-too": Message(
        "graduations every {step:g} on an axis from {low:g} to {high:g} are too many",
        "des graduations tous les {step:g} sur un axe de {low:g} à {high:g} sont trop nombreuses",
    ),
    "colour-number-not": Message(
        "colour number {colour} is not in 0..{n_names}",
        "le numéro de couleur {colour} n'est pas dans 0..{n_names}",
    ),
    "no-colour": Message(
        "'{name}' is no colour",
        "'{name}' n'est pas une couleur",
        "colours are {names:words}",
        "les couleurs sont {names:words}",
    ),
    "line-no-finite-number": Message(
        "{name}, line {line}: '{text}' is no finite number",
        "{name}, ligne {line} : '{text}' n'est pas un nombre fini",
        "a gap in a record: fill it before, or leave the line out",
        "un trou dans un enregistrement : comblez-le avant, ou ôtez la ligne",
    ),
    "cannot-read": Message(
        "{path} cannot be read: {strerror}",
        "{path} ne peut être lu : {strerror}",
    ),
    "line-no-number": Message(
        "{name}, line {line}: '{text}' is no number",
        "{name}, ligne {line} : '{text}' n'est pas un nombre",
        "begin behind the titles with 'DEBU', or name another separator with 'SEPA'",
        "commencez après les titres par 'DEBU', ou nommez un autre séparateur par 'SEPA'",
    ),
    "cannot-written": Message(
        "{path} cannot be written: {strerror}",
        "{path} ne peut être écrit : {strerror}",
        "check the directory given by --out, its rights and the space left on the disk",
        "vérifiez le répertoire donné par --out, ses droits et la place qui reste sur le disque",
    ),
    "file-held": Message(
        "{path} is held by another program and cannot be replaced{other:?; what was to stand there "
        "is in {other}}",
        "{path} est tenu par un autre programme et ne peut être remplacé{other:? ; ce qui devait "
        "s'y trouver est dans {other}}",
        "close it there (a spreadsheet, a viewer) and run again",
        "fermez-le là (un tableur, une visionneuse) et relancez",
    ),
    "not-readable-pvd-collection": Message(
        "{path} is not a readable .pvd collection: {error}",
        "{path} n'est pas une collection .pvd lisible : {error}",
    ),
    "step-time-comes-after": Message(
        "step at time {time:g} comes after the one at {last_time:g}",
        "le pas au temps {time:g} vient après celui au temps {last_time:g}",
    ),
    "series-parts-step-brings": Message(
        "the series has the parts ({old}), the step brings ({new})",
        "la série a les parties ({old}), le pas apporte ({new})",
    ),
    "series-mesh-changed": Message(
        "{path} has one mesh for all its steps, and this step's mesh{part} is another",
        "{path} a un seul maillage pour tous ses pas, et le maillage de ce pas{part} en est un "
        "autre",
        "begin another file, or write .vtu files, whose meshes may differ from step to step: 'VTU'",
        "commencez un autre fichier, ou écrivez des fichiers .vtu, dont les maillages peuvent "
        "changer d'un pas à l'autre : 'VTU'",
    ),
    "series-array-changed": Message(
        "in {path} {names} had another number of components in the steps before",
        "dans {path}, {names} n'avait pas ce nombre de composantes aux pas précédents",
        "give the field another name from here on, or write .vtu files: 'VTU'",
        "donnez un autre nom au champ à partir d'ici, ou écrivez des fichiers .vtu : 'VTU'",
    ),
    "cells-no-vtk-counterpart": Message(
        "cells {cell_type} have no VTK counterpart",
        "les éléments {cell_type} n'ont pas d'équivalent VTK",
    ),
    "archive-too-large": Message(
        "{name} unpacks to more than {most:.0f} MB, which no SAUV writes into {size:.1f} MB",
        "{name} se déploie sur plus de {most:.0f} Mo, ce qu'aucun SAUV n'écrit dans {size:.1f} Mo",
        "the file is damaged or was made to fill the memory",
        "le fichier est abîmé ou fait pour remplir la mémoire",
    ),
    "no-file-sauv-ssilang": Message(
        "{name} is no file that SAUV of ssilang wrote: {error}",
        "{name} n'est pas un fichier écrit par SAUV de ssilang : {error}",
        "files of Cast3M itself cannot be restored",
        "les fichiers de Cast3M même ne peuvent être restitués",
    ),
    "written-later-version-ssilang": Message(
        "{name} was written by a later version of ssilang, {by}; this is {own}",
        "{name} a été écrit par une version plus récente de ssilang, {by} ; celle-ci est {own}",
        "read it with that version, or let this one write it again",
        "le lire avec cette version, ou le faire écrire à nouveau par celle-ci",
    ),
    "holds-unknown-kind-data": Message(
        "{name} holds an unknown kind of data '{kind}'",
        "{name} contient des données de nature inconnue '{kind}'",
    ),
    "damaged": Message(
        "{name} is damaged: {error}",
        "{name} est endommagé : {error}",
    ),
    "folder-in-use": Message(
        "another run writes into {folder}: process {pid}{host:? on {host}}",
        "un autre calcul écrit dans {folder} : processus {pid}{host:? sur {host}}",
        "wait for its end, or choose another folder with --out{elsewhere:?; if that run is over, "
        "remove {elsewhere}}",
        "attendez sa fin, ou choisissez un autre dossier par --out{elsewhere:? ; si ce calcul est "
        "fini, supprimez {elsewhere}}",
    ),
    "output-folder-gone": Message(
        "the output folder {folder} was removed or exchanged during the run",
        "le dossier de sortie {folder} a été supprimé ou échangé pendant le calcul",
    ),
    "no-such-place": Message(
        "no file can be called '{name}': {reason}",
        "aucun fichier ne peut s'appeler '{name}' : {reason}",
    ),
    "name-stays-here": Message(
        "'{name}' cannot be the name of a file on Windows: {reason}",
        "'{name}' ne peut être le nom d'un fichier sous Windows : {reason}",
        "another name, if the files are to be read there",
        "un autre nom, si les fichiers doivent y être lus",
    ),
    "series-files-gone": Message(
        "files that the run wrote for the series {path} are gone: {names}",
        "des fichiers écrits pour la série {path} ont disparu : {names}",
    ),
    "damaged-object": Message(
        "{name} is damaged: {part} of an object '{kind}' cannot be",
        "{name} est endommagé : {part} d'un objet '{kind}' ne peut être",
    ),
    "save-file-holds-object": Message(
        "the save file holds an object of unknown kind '{tag}'",
        "le fichier de sauvegarde contient un objet de nature inconnue '{tag}'",
    ),
    "object-class-cannot-saved": Message(
        "an object of class {name} cannot be saved",
        "un objet de classe {name} ne peut être sauvé",
    ),
    "save-file-asks-no": Message(
        "the save file asks for '{name}', which is no saved object's class",
        "le fichier de sauvegarde demande '{name}', qui n'est pas une classe d'objets sauvés",
    ),
    "save-file-asks-not": Message(
        "the save file asks for '{name}', which does not exist here",
        "le fichier de sauvegarde demande '{name}', qui n'existe pas ici",
    ),
    "line-no-npts-dt": Message(
        "{name}: line 4 has no 'NPTS= ..., DT= ... SEC'",
        "{name} : la ligne 4 n'a pas de 'NPTS= ..., DT= ... SEC'",
        "a PEER file has 4 lines of text before its values; LIRE 'CSV' reads plain columns",
        "un fichier PEER a 4 lignes de texte avant ses valeurs ; LIRE 'CSV' lit de simples "
        "colonnes",
    ),
    "line-no-number-2": Message(
        "{name}, line {number}: '{rest}' is no number",
        "{name}, ligne {number} : '{rest}' n'est pas un nombre",
    ),
    "field-cells-not-cover": Message(
        "the field in cells does not cover the mesh",
        "le champ par élément ne couvre pas le maillage",
    ),
    "cells-no-avs-counterpart": Message(
        "cells {cell_type} have no AVS counterpart",
        "les éléments {cell_type} n'ont pas d'équivalent AVS",
    ),
    "avs-file-cut": Message(
        "{name} is cut: it has fewer lines than its first one says",
        "{name} est tronqué : il a moins de lignes que n'en annonce la première",
        "write or fetch it again",
        "écrivez-le ou récupérez-le de nouveau",
    ),
    "no-readable-avs-file": Message(
        "{name} is no readable AVS file: {error}",
        "{name} n'est pas un fichier AVS lisible : {error}",
    ),
    "stl-holds-tri3-only": Message(
        "STL holds TRI3 only, the mesh has {others:?{others}|no cells}",
        "STL ne contient que des TRI3, le maillage {others:?a des {others}|n'a pas d'éléments}",
    ),
    "deck-holds-no-such-cells": Message(
        "SORT '{word}' writes no {others:?{others}|mesh without cells}",
        "SORT '{word}' n'écrit pas de {others:?{others}|maillage sans éléments}",
        "cells that it writes here: {known}",
        "éléments qu'il écrit ici : {known}",
    ),
    "holds-no-triangles": Message(
        "{name} holds no triangles",
        "{name} ne contient pas de triangles",
    ),
    "no-readable-stl-file": Message(
        "{name} is no readable STL file: {error}",
        "{name} n'est pas un fichier STL lisible : {error}",
    ),
    "holds-no-nodes-dataset": Message(
        "{name} holds no nodes (dataset 2411)",
        "{name} ne contient pas de noeuds (dataset 2411)",
    ),
    "no-readable-unv-file": Message(
        "{name} is no readable UNV file: {error}",
        "{name} n'est pas un fichier UNV lisible : {error}",
    ),
    "no-readable-mesh-file": Message(
        "{name} cannot be read as {kind}{error:?: {error}}",
        "{name} ne se lit pas comme {kind}{error:? : {error}}",
        "the file is damaged, of another format or version, or has cells that are not read",
        "le fichier est abîmé, d'un autre format ou d'une autre version, ou a des éléments qui ne "
        "se lisent pas",
    ),
    "mesh-file-empty": Message(
        "{name} holds no nodes that are read as {kind}",
        "{name} ne contient pas de noeuds lisibles comme {kind}",
        "an AVS file ends in .inp too: OPTI LECT names it, LIRE 'AVS' reads it",
        "un fichier AVS finit aussi par .inp : OPTI LECT le nomme, LIRE 'AVS' le lit",
    ),
    "mesh-file-cut": Message(
        "{name} is cut: {kind} ends with {end}",
        "{name} est tronqué : {kind} finit par {end}",
    ),
    "mesh-file-names-no-node": Message(
        "{name} ({kind}) is damaged: it names a node that it does not hold",
        "{name} ({kind}) est abîmé : il nomme un noeud qu'il ne contient pas",
    ),
    "mesh-file-names-no-cell": Message(
        "{name} ({kind}) is damaged: it names a cell that it does not hold",
        "{name} ({kind}) est abîmé : il nomme un élément qu'il ne contient pas",
    ),
    "mesh-library-missing": Message(
        "files of {kind} are read and written by {library}, which is not installed",
        "les fichiers {kind} se lisent et s'écrivent par {library}, qui n'est pas installé",
        "pip install 'ssilang[med]'",
        "pip install 'ssilang[med]'",
    ),
    "gmsh-missing": Message(
        "a .geo file is meshed by Gmsh, which {error:?cannot start: {error}|is not installed}",
        "un fichier .geo est maillé par Gmsh, qui {error:?ne peut démarrer : {error}|n'est pas "
        "installé}",
        "{error:?apt-get install libgl1 libglu1-mesa libgomp1 libxft2 libxcursor1 libxinerama1|"
        "pip install 'ssilang[gmsh]'}",
        "{error:?apt-get install libgl1 libglu1-mesa libgomp1 libxft2 libxcursor1 libxinerama1|"
        "pip install 'ssilang[gmsh]'}",
    ),
    "geo-reaches-out": Message(
        "{name} is not run: '{word}' runs programs or writes files",
        "{name} n'est pas exécuté : '{word}' lance des programmes ou écrit des fichiers",
        "mesh it with gmsh and read the .msh",
        "le mailler par gmsh et lire le .msh",
    ),
    "geo-unguarded": Message(
        "{name} is not run: a .geo may start programs, and this system cannot keep Gmsh from it",
        "{name} n'est pas exécuté : un .geo peut lancer des programmes, et ce système ne peut en "
        "empêcher Gmsh",
        "if you trust the file: --allow-geo; else mesh it with gmsh and read the .msh (the guard "
        "is Landlock, of Linux 5.13 and later)",
        "si le fichier est de confiance : --allow-geo ; sinon le mailler par gmsh et lire le .msh "
        "(l'enceinte est Landlock, de Linux 5.13 et plus)",
    ),
    "geo-takes-long": Message(
        "Gmsh has not meshed {name} within {seconds} s and was ended",
        "Gmsh n'a pas maillé {name} en {seconds} s et a été arrêté",
        "coarser sizes; or more time: SSILANG_GEO_SECONDS in the environment",
        "des tailles plus grandes ; ou plus de temps : SSILANG_GEO_SECONDS dans l'environnement",
    ),
    "mesh-cells-not-written": Message(
        "{kind} has no {others}",
        "{kind} n'a pas de {others}",
        "cells that are written: {known}",
        "éléments qui s'écrivent : {known}",
    ),
    "mesh-part-name": Message(
        "no group of {kind} can be called '{name}'",
        "aucun groupe {kind} ne peut s'appeler '{name}'",
        "a name of at most 80 letters without accents and signs",
        "un nom d'au plus 80 lettres sans accents ni signes",
    ),
    "nastran-coordinate-system": Message(
        "{name} gives nodes in coordinate systems of their own, which are not read",
        "{name} donne des noeuds dans des repères propres, qui ne sont pas lus",
        "write the nodes in the basic system: field 3 of GRID blank or 0",
        "écrivez les noeuds dans le repère de base : champ 3 de GRID vide ou nul",
    ),
    "abaqus-keyword-not-read": Message(
        "{name}: *{word} makes or moves nodes or elements, and is not read",
        "{name} : *{word} fait ou déplace des noeuds ou des éléments, et n'est pas lu",
        "write the mesh out in full: *NODE and *ELEMENT, one part without instances that move",
        "écrivez le maillage en entier : *NODE et *ELEMENT, une pièce sans instance déplacée",
    ),
    "abaqus-several-parts": Message(
        "{name} has several *PART, whose numbers mean different nodes",
        "{name} a plusieurs *PART, dont les numéros désignent des noeuds différents",
        "write it flat, without parts, or each part into a file of its own",
        "écrivez-le à plat, sans pièces, ou chaque pièce dans son fichier",
    ),
    "esm-without-step": Message(
        "{name}: the head has no 'SAMPLING_INTERVAL_S: ...'",
        "{name} : l'en-tête n'a pas de 'SAMPLING_INTERVAL_S: ...'",
        "ESM and ITACA files begin with lines 'KEY: VALUE'; LIRE 'PEER', 'COSMOS', 'SIGNAL' read "
        "others",
        "les fichiers ESM et ITACA commencent par des lignes 'CLE: VALEUR' ; LIRE 'PEER', 'COSMOS' "
        "et 'SIGNAL' lisent les autres",
    ),
    "esm-other-count": Message(
        "{name}: NDATA says {count} {count:value|values}, the file holds {n_values}",
        "{name} : NDATA annonce {count} {count:valeur|valeurs}, le fichier en contient {n_values}",
        "the file is cut, or has further columns: fetch it again",
        "le fichier est coupé, ou a d'autres colonnes : le reprendre",
    ),
    "cosmos-other-version": Message(
        "{name}: its first line says {version:?version {version}|no version} of the COSMOS format, "
        "1.20 is read",
        "{name} : sa première ligne dit {version:?la version {version}|aucune version} du format "
        "COSMOS, la 1.20 est lue",
        "'(Format v01.20 with 13 text lines)' stands in a file of that version; LIRE 'SIGNAL' "
        "reads tables with titles",
        "'(Format v01.20 with 13 text lines)' est écrit dans un tel fichier ; LIRE 'SIGNAL' lit "
        "les tables à titres",
    ),
    "cosmos-without-step": Message(
        "{name}: the 34th of the 100 reals, the step, is no positive number",
        "{name} : le 34e des 100 réels, le pas, n'est pas un nombre positif",
    ),
    "cosmos-without-series": Message(
        "{name}: no line says how many accelerations, velocities or displacements follow",
        "{name} : aucune ligne ne dit combien d'accélérations, vitesses ou déplacements suivent",
        "raw counts (.V0) are not read: fetch the volume 1 or 2",
        "les comptes bruts (.V0) ne sont pas lus : récupérez le volume 1 ou 2",
    ),
    "cosmos-duration": Message(
        "{name}: {said:g} s, says the line above the values, their step makes {duration:.4g} s",
        "{name} : {said:g} s, dit la ligne au-dessus des valeurs, leur pas donne {duration:.4g} s",
        "the file is damaged: fetch it again",
        "le fichier est abîmé : récupérez-le de nouveau",
    ),
    "cosmos-too-few": Message(
        "{name}: line {line} says {count} {count:value|values}, {n_values} "
        "{n_values:follows|follow}",
        "{name} : la ligne {line} annonce {count} {count:valeur|valeurs}, {n_values} "
        "{n_values:suit|suivent}",
        "the file is cut: fetch it again",
        "le fichier est tronqué : récupérez-le de nouveau",
    ),
    "titled-time-unit": Message(
        "{name}: '{title}' names no unit of time that is known",
        "{name} : '{title}' ne nomme pas d'unité de temps connue",
        "the first column are times, in s or ms: time (s)",
        "la première colonne contient les temps, en s ou ms : temps (s)",
    ),
    "titled-times-fall": Message(
        "{name}, line {line}: the time is not above that of the line before",
        "{name}, ligne {line} : le temps ne dépasse pas celui de la ligne d'avant",
        "the first column are times; values without times: LIRE 'CSV', then EVOL 'MANU'",
        "la première colonne contient les temps ; sans temps : LIRE 'CSV', puis EVOL 'MANU'",
    ),
    "titled-no-table": Message(
        "{name} has no two lines of numbers in two columns",
        "{name} n'a pas deux lignes de nombres en deux colonnes",
        "a line of titles, then times and values: 0.01; 0.25",
        "une ligne de titres, puis temps et valeurs : 0.01; 0.25",
    ),
    "titled-other-columns": Message(
        "{name}, line {line}: {count} {count:cell|cells}, the first line of numbers has {needed}",
        "{name}, ligne {line} : {count} {count:case|cases}, la première ligne de nombres en a "
        "{needed}",
    ),
    "record-not-finite": Message(
        "{name} has values that are too large for a number",
        "{name} a des valeurs trop grandes pour un nombre",
    ),
    "record-empty": Message(
        "{name} holds no value, or says that it has none",
        "{name} ne contient aucune valeur, ou dit n'en avoir aucune",
        "the number of values in its head (NPTS) is that of the values below it",
        "le nombre de valeurs de l'en-tête (NPTS) est celui des valeurs qui suivent",
    ),
    "line-says-values-file": Message(
        "{name}: line 4 says {count} {count:value|values}, the file holds {n_values}",
        "{name} : la ligne 4 annonce {count} {count:valeur|valeurs}, le fichier en contient "
        "{n_values}",
        "the file is cut: fetch it again",
        "le fichier est tronqué : récupérez-le de nouveau",
    ),
    # ---- reasons of the system (ssilang/system_reasons.py)
    "reason-missing": Message("no such file or folder", "fichier ou dossier introuvable"),
    "reason-forbidden": Message("permission denied", "accès refusé"),
    "reason-folder": Message("it is a folder", "c'est un dossier"),
    "reason-no-folder": Message(
        "a part of its path is no folder", "une partie de son chemin n'est pas un dossier"
    ),
    "reason-there-already": Message("it exists already", "il existe déjà"),
    "reason-name-too-long": Message("the name is too long", "le nom est trop long"),
    "reason-drive": Message(
        "it begins with a drive of Windows, which this system has not",
        "il commence par un lecteur de Windows, que ce système n'a pas",
    ),
    "reason-named-device": Message("'{part}' is a device there", "'{part}' y est un périphérique"),
    "reason-sign": Message("no name has {signs:words} there", "aucun nom n'y a de {signs:words}"),
    "reason-end": Message(
        "'{part}' ends in a point or a blank, which are dropped there",
        "'{part}' finit par un point ou un blanc, qui y sont ôtés",
    ),
    "reason-links-in-a-ring": Message(
        "its links lead back to themselves", "ses liens ramènent à eux-mêmes"
    ),
    "reason-disk-full": Message("no space is left on the disk", "le disque est plein"),
    "reason-read-only": Message(
        "the file system is read-only", "le système de fichiers est en lecture seule"
    ),
    "reason-file-too-large": Message("the file is too large", "le fichier est trop gros"),
    "reason-many-files-open": Message("too many files are open", "trop de fichiers sont ouverts"),
    "reason-device": Message("the device failed", "le périphérique a échoué"),
    "reason-stream-closed": Message("the stream is closed", "le flux est fermé"),
    "reason-nought-in-a-name": Message(
        "the sign of code 0 stands in no name", "le signe de code 0 n'entre dans aucun nom"
    ),
}
