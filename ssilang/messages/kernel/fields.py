"""What ssilang/kernel/fields refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "component-field-node": Message(
        "component {name} is {values:g} in one field and {values_2:g} in the other at node {both}",
        "la composante {name} vaut {values:g} dans un champ et {values_2:g} dans l'autre au "
        "noeud {both}",
        "diffuse fields must agree where both are defined; NOER keeps the first",
        "des champs diffus doivent s'accorder là où les deux existent ; NOER garde le premier",
    ),
    "no-field-decompose": Message(
        "there is no field to decompose",
        "il n'y a aucun champ à décomposer",
    ),
    "no-component-left-decompose": Message(
        "no component is left to decompose",
        "il ne reste aucune composante à décomposer",
    ),
    "fields-no-energy-no": Message(
        "the fields have no energy: there is no mode",
        "les champs n'ont pas d'énergie : il n'y a pas de mode",
    ),
    "curves-of-one-component": Message(
        "curves are made of one component, here are {names:words}",
        "les évolutions se font d'une seule composante, voici {names:words}",
        "EXCO takes one of them",
        "EXCO en extrait une",
    ),
    "curves-of-other-cells": Message(
        "a zone of {n_cells} {n_cells:cell|cells} is not, at the same points, in all fields",
        "une zone de {n_cells} {n_cells:élément|éléments} n'est pas, aux mêmes points, dans tous "
        "les champs",
    ),
    "component-holds-objects-not": Message(
        "component {name} holds objects, not numbers",
        "la composante {name} contient des objets, pas des nombres",
    ),
    "field-no-component-2": Message(
        "the field has no component {name}",
        "le champ n'a pas de composante {name}",
        "its components are: {known:words}",
        "ses composantes sont : {known:words}",
    ),
    "component-differs-between-two": Message(
        "component {name} differs between the two fields on the same cells",
        "la composante {name} diffère entre les deux champs sur les mêmes éléments",
        "write + to add them",
        "écrivez + pour les additionner",
    ),
    "field-field-not-defined-2": Message(
        "a field ({components:words}) by a field ({components_2:words}) is not defined",
        "un champ ({components:words}) par un champ ({components_2:words}) n'est pas défini",
        "one of them has one component, or three lists of words say what goes with what",
        "l'un d'eux a une seule composante, ou trois listes de mots disent ce qui va avec quoi",
    ),
    "field-empty": Message(
        "the field is empty",
        "le champ est vide",
    ),
    "no-value-looked-cells": Message(
        "no value is looked for in cells of type {cell_type}",
        "aucune valeur ne se cherche dans les éléments de type {cell_type}",
        "those that can be cut are {value:words}",
        "ceux qui se coupent sont {value:words}",
    ),
    "field-none-components": Message(
        "the field has none of the components {columns:words}",
        "le champ n'a aucune des composantes {columns:words}",
    ),
    "field-field-not-defined": Message(
        "a field ({a:words}) by a field ({b:words}) is not defined",
        "un champ ({a:words}) par un champ ({b:words}) n'est pas défini",
        "one of them has the only component SCAL, or three lists of words say what goes with what",
        "l'un d'eux a la seule composante SCAL, ou trois listes de mots disent ce qui va avec quoi",
    ),
    "field-no-component": Message(
        "the field has no component {name}",
        "le champ n'a pas de composante {name}",
        "{known:?its components are: {known:words}|it has none}",
        "{known:?ses composantes sont : {known:words}|il n'en a aucune}",
    ),
    "fields-natures-cannot-joined": Message(
        "fields of natures {nature} and {nature_2} cannot be joined",
        "des champs de natures {nature} et {nature_2} ne se réunissent pas",
    ),
    "field-divide-zero": Message(
        "the field to divide by has a zero",
        "le champ diviseur a un zéro",
    ),
    "component-stands-field": Message(
        "component {name} stands at {support} in one field and at {support_2} in the other",
        "la composante {name} est en {support} dans un champ et en {support_2} dans l'autre",
    ),
    "zone-first-field-not": Message(
        "a zone of {n_cells} {cell_type} of the first field is not a zone of the second",
        "une zone de {n_cells} {cell_type} du premier champ n'est pas une zone du second",
    ),
    "field-components": Message(
        "the field has the components {components:words}",
        "le champ a les composantes {components:words}",
    ),
    "field-not-stand-nodes": Message(
        "the field does not stand at nodes",
        "le champ n'est pas aux noeuds",
    ),
    "field-holds-no-principal": Message(
        "the field holds no principal stresses",
        "le champ ne contient pas de contraintes principales",
    ),
}
