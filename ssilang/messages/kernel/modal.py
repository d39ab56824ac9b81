"""What ssilang/kernel/modal refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "shapes-no-strains": Message(
        "models MODAL and STATIQUE have no strains of their own",
        "les modèles MODAL et STATIQUE n'ont pas de déformations propres",
        "recombine the displacement with RECO, then use the model of the body",
        "recombinez le déplacement par RECO, puis prenez le modèle du corps",
    ),
}
