"""What ssilang/kernel/contact refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "side-contact-cell-without": Message(
        "a side of contact has a cell without size",
        "un bord de contact a un élément de taille nulle",
    ),
    "cable-branches-node": Message(
        "the cable branches at node {at}",
        "le câble a un branchement au noeud {at}",
        "a model for each cable",
        "faites un modèle par câble",
    ),
    "no-node-cable-lies": Message(
        "no node of the cable lies in the body",
        "aucun noeud du câble n'est dans le volume",
    ),
    "mass-contact-nodes-cannot": Message(
        "the mass of the contact nodes cannot be taken off: no stiffness ties them to others",
        "la masse des noeuds de contact ne peut être ôtée : aucune raideur ne les lie à d'autres",
    ),
    "side-contact-made-not": Message(
        "a side of contact is made of {wanted:or}, not {cell_type}",
        "un bord de contact se fait de {wanted:or}, pas de {cell_type}",
    ),
}
